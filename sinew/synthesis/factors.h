// What steps share that solve with the factors of the mass matrix of all coordinates: numbers of
// all coordinates one after the other, those of a floating base first.
#pragma once

#include <functional>

#include "sinew/synthesis/context.h"

namespace sinew::synthesis {

// How many numbers the velocities of all coordinates are.
std::uint32_t width(const Context& context);

// The same as a constant data block, which tells operators how long their arguments are.
BlockIndex make_width(Context& context);

// A block for numbers of all coordinates: "joint-forces", "joint-accelerations".
algorithm::BlockSpec of_all(const Context& context, std::string_view slot,
                            std::string_view quantity);

// Joins a force of each coordinate into one block; `force` gives it for each part of a coordinate,
// a joint of the tree that follows none.
void join_forces(Context& context, const std::function<BlockIndex(std::size_t part)>& force,
                 BlockIndex all);

}  // namespace sinew::synthesis
