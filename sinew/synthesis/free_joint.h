// Spherical joints, and floating ones that are not a base. The tree has a turn (and a slide) about
// (along) each axis of the successor for such a joint, one after the other and all at zero: forces,
// inertias and Jacobians are theirs. The pose is all across the first of them, the velocity and the
// acceleration across the last, so that nothing is counted twice: the bodies between move with the
// predecessor and weigh nothing.
#pragma once

#include "sinew/synthesis/context.h"
#include "sinew/synthesis/joint_edge.h"

namespace sinew::synthesis {

struct FreePart {
  const RobotCompound* whole = nullptr;  // null: the joint is no part of a free one
  bool first = false, last = false;
};

FreePart free_part(const Context& context, Id joint);

// Whether the relative twist of an edge is all of a floating joint's, seen from its successor: its
// origin may accelerate while the numbers of its velocity do not change.
bool floats_freely(const Context& context, const JointEdge& edge);
bool floats_freely(const Context& context, const RobotJoint& joint);

// The acceleration of a free joint, all its numbers: given, or put together from those of its
// parts.
BlockIndex whole_acceleration(Context& context, const RobotCompound& whole);

// Its position, velocity or acceleration as a data block, for the frames of its first or last part.
algorithm::BlockSpec whole_quantity(const Context& context, const RobotCompound& whole,
                                    std::string_view slot);

}  // namespace sinew::synthesis
