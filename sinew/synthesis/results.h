// From what the steps have computed for the joints of the tree to a user's numbers: of coordinates
// (coordinates.h), with the share of joints that follow others.
#pragma once

#include <string_view>

#include "sinew/synthesis/context.h"

namespace sinew::synthesis {

// The number of a coordinate's joint forces, accelerations, …: as a user sees them. `joint` is the
// coordinate's.
BlockIndex gathered(Context& context, std::string_view slot, Id joint);

// The force of one joint of the tree with its share of those that follow it, in a slot that steps
// have filled.
BlockIndex coupled_force(Context& context, std::string_view slot, std::size_t joint);

// The same of what one effect (effects.h) exerts; algorithm::kNoIndex where it reaches none of
// them.
BlockIndex coupled_effect(Context& context, std::string_view slot, Id effect, std::size_t joint);

// A matrix that the steps have filled for the joints of the tree, for the coordinates instead.
BlockIndex coupled_matrix(Context& context, BlockIndex matrix);

// Makes a result an output, after gathering and coupling. `name`: instead of the block's own.
void hand_out(Context& context, std::string_view slot, Id element, std::string_view name);

}  // namespace sinew::synthesis
