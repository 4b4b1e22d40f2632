// Chooses the frames that nobody named. A joint's frames may be turned about its axis and slid
// along it (a prismatic joint's also aside); turned and slid well, most entries of the constant
// placements are 0 or 1, and what is 0 or 1 costs nothing in generated code. For a serial chain
// this finds the convention of Denavit and Hartenberg (1955): x along the common normal of two
// axes, so that a constant rotation is one about x.
#pragma once

#include "sinew/model/tree.h"

namespace sinew::model {

// Moves the frame of every body but the root's, with everything that is seen from it. Where nothing
// is gained, frames stay as the model has them. An entry within `tolerance` of 0 or 1 counts as
// that.
void choose_frames(Tree& tree, double tolerance);

// Moves one body's frame to `X`, its new pose in the old frame: placements, inertia, and the
// joint's frame. X must keep the joint's axis.
void move_frame(Tree& tree, std::uint32_t body, const Pose& X);

// The longest distance that the tree knows of [m]: of placements, centres of mass, and how far from
// them a body's mass lies. Zero if all of it is in one point.
double longest_length(const Tree& tree);

// Clears the dust of computing from all constants: what is within `tolerance` of 0, 1 or -1 is
// that, and so is a part of an inertia beside its others; lengths below `length_tolerance` are 0.
void snap(Tree& tree, double tolerance, double length_tolerance);

}  // namespace sinew::model
