// From a model's bodies and joints to a tree: which body is the root, in which order the joints are
// walked, and which way each is walked.
#pragma once

#include <string>
#include <vector>

#include "sinew/model/rigid_bodies.h"

namespace sinew::model {

struct SpanningTree {
  struct Step {
    int joint = kNone;              // of the structure
    int near = kNone, far = kNone;  // attachments: frames of the predecessor and the successor
    bool against = false;           // from the model's child to its parent
    int predecessor = kNone;        // the step that leads to it; kNone: the root
  };
  int root_body = kNone;    // of the rigid bodies
  int root_link = kNone;    // its first link
  int root_frame = kNone;   // the frame in which the root is seen
  std::vector<Step> steps;  // depth first, in the model's joint order
};

// The frame that a link's own data are given in: where its joint attaches it, else the frame from
// which its others are placed, else that of its inertia, else its first. kNone for a link without
// frames.
// `guessed`: whether the model leaves it open, there being several such frames, or none.
int root_frame_of(const Structure& structure, int link, bool* guessed = nullptr);

// See NormaliseOptions for `base` and `tips`. Errors: no root or several, a loop, no way to a tip.
SpanningTree find_spanning_tree(const Structure& structure, const RigidBodies& bodies,
                                const graph::Terms& terms, const graph::Places& places,
                                const std::string& base, const std::vector<std::string>& tips,
                                Report& report);

}  // namespace sinew::model
