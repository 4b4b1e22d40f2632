// Steps of hybrid dynamics: acceleration constraints, external wrenches and joint forces, all at
// once, in three sweeps (Popov and others 1978; Vereshchagin 1989; Shakhimardanov 2015). What they
// need depends on the drivers that a query gives, so they are made for each query.
//
//   outward  poses, velocities, accelerations without joint accelerations; where drivers act
//   inward   articulated inertias; the effect of each driver and of each unit constraint force on
//            every joint; at the root, the magnitudes of the constraint forces
//   outward  the joint accelerations
#pragma once

#include <vector>

#include "sinew/synthesis/motion_drivers.h"
#include "sinew/synthesis/step.h"

namespace sinew::synthesis {

// steps_constraints.cpp
Step constraint_wrench_step();
Step constraint_bias_step();
Step constraint_lever_step();

// steps_driver_effects.cpp
Step driver_effects_step(const MotionDrivers& drivers);

// steps_constraint_magnitudes.cpp
Step constraint_magnitudes_step();
Step driver_scale_step(const MotionDrivers& drivers);
Step total_magnitudes_step(const MotionDrivers& drivers);

// steps_hybrid_acceleration.cpp
Step constrained_drive_step(const MotionDrivers& drivers);
Step constrained_acceleration_step();
Step driver_acceleration_step(const MotionDrivers& drivers);
Step constraint_force_step();
Step control_force_step(const MotionDrivers& drivers);

// All that these drivers call for; empty when they call for none. They come before other steps that
// give the same.
std::vector<Step> hybrid_steps(const MotionDrivers& drivers);

}  // namespace sinew::synthesis
