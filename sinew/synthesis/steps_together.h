// Steps for several quantities that are asked at once: what one has computed makes another one
// cheaper. Each does what a step of steps.cpp does, from other slots; the planner takes them first.
//
// Inverse dynamics is linear in what moves the robot: gravity, velocities (with the external
// wrenches) and joint accelerations. Where only one sum of these is asked, carrying the sum through
// the sweeps costs least. Where several are asked, each part is carried once and alone: a robot at
// rest takes no products of velocities, and gravity by itself turns no body.
#pragma once

#include <vector>

#include "sinew/synthesis/resolve_query.h"

namespace sinew::synthesis {

// What decides beside the question.
struct Circumstances {
  std::array<double, 3> gravity = {};  // [m/s^2]; of the root's directions
  bool gravity_is_constant = false;
  bool has_task = false;  // its wrenches act on sums
};

std::vector<Step> steps_together(const graph::View& view, const Robot& robot, const Query& query,
                                 const Resolved& resolved, const Circumstances& circumstances);

}  // namespace sinew::synthesis
