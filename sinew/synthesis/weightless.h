// Joints that move nothing: a force on one has no finite acceleration.
#pragma once

#include "sinew/synthesis/step.h"

namespace sinew::synthesis {

// For each body: refuses one that ends a chain and has no inertia about (or along) its joint's
// axis, and a floating base without mass at such an end.
Visitor refuse_weightless();

}  // namespace sinew::synthesis
