// A compound joint as the sequence of turns and slides that the tree has for it.
#pragma once

#include <vector>

#include "sinew/model/structure.h"

namespace sinew::model {

struct CompoundPart {
  Id iri;  // of the model's node for this motion; null where there is none
  JointKind kind = JointKind::kRevolute;
  Pose placement;        // of its joint frame: in the near attachment for the first, else in the
                         // frame of the part before
  Pose in_far;           // of its moved frame in the far attachment, when all positions are zero
  bool follows = false;  // the first part, `ratio` times
  double ratio = 1;
  JointLimits limits;
};

// Whether the motions of such a joint may be taken in any order, so that it can be walked both
// ways.
bool commutes(JointKind kind);

// The parts from the near attachment to the far one. `against`: from the model's child to its
// parent; then all axes point the other way, so that positions keep their sign.
//
// A free joint's parts are about and along x, y, z of the successor: z of each part's frames is the
// next axis of the successor's frame (x, y, z, x, …), each placement the turn from one to the next.
std::vector<CompoundPart> parts_of(const Structure::Joint& joint, bool against);

}  // namespace sinew::model
