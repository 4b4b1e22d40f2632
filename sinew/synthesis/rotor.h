// Rotors behind gears: a rotor resists acceleration of its joint about its own axis (reflected
// inertia); what it does while the axis itself turns is left to the inertia of the link that holds
// it.
#pragma once

#include "sinew/synthesis/joint_edge.h"

namespace sinew::synthesis {

bool has_rotor(const Context& context, Id joint);

// The blocks that compute_with_rotor needs for a force in this slot, where the joint has a rotor.
void make_rotor(Context& context, const JointEdge& edge, std::string_view slot);

// The share of a wrench that the joint carries, and the rotor's: `operation` takes the first, then
// `others`, then the rotor's inertia. Without a rotor the first alone.
void compute_with_rotor(Context& context, const JointEdge& edge, std::string_view operation,
                        BlockIndex wrench, std::initializer_list<BlockIndex> others,
                        BlockIndex force);

}  // namespace sinew::synthesis
