// Joints that follow others (mimicry) in the tree: each to the joint at the head of its line, whose
// position is free.
#pragma once

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/model/structure.h"

namespace sinew::model {

// Sets follows, ratio and offset of the tree's joints. Errors: a leader or follower that is no
// joint of one degree of freedom, one that is not in the tree, a circle.
void couple(const Structure& structure, const graph::Terms& terms, const graph::Places& places,
            Tree& tree, Report& report);

}  // namespace sinew::model
