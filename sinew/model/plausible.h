// Whether stated numbers can be those of a real robot.
#pragma once

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/model/structure.h"

namespace sinew::model {

// Moments of inertia of a real body satisfy the triangle inequality: its second moments of mass,
// (tr I / 2) 1 - I about the centre of mass, have no negative eigenvalue. Published data violate it
// by rounding, so a violation is counted in parts of the largest moment: up to the first it passes,
// up to the second it is a warning, beyond an error, unless `lenient`: equations of motion can be
// solved all the same. An eigenvalue of I itself that is negative is an error from the first bound
// on.
constexpr double kTriangleWarning = 1e-6;
constexpr double kTriangleError = 0.05;

void check_inertias(const Structure& structure, const graph::Terms& terms,
                    const graph::Places& places, bool lenient, Report& report);

// Limits that leave no room to move, and the like.
void check_limits(const Structure& structure, const graph::Terms& terms,
                  const graph::Places& places, Report& report);

}  // namespace sinew::model
