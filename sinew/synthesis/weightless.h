// Joints that move nothing: a force on one has no finite acceleration.
#pragma once

#include "sinew/base/error.h"
#include "sinew/synthesis/step.h"

namespace sinew::synthesis {

// For each body: refuses one that ends a chain and has no inertia about (or along) its joint's
// axis, and a floating base without mass at such an end.
Visitor refuse_weightless();

// Reports a question about the whole robot's mass (its centre, momentum, energy) where nothing has
// any.
void check_there_is_mass(const Context& context, Report& report);

}  // namespace sinew::synthesis
