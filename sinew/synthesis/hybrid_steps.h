// Steps of hybrid dynamics: acceleration constraints, external wrenches and joint forces, all at
// once, in three sweeps (Popov and others 1978; Vereshchagin 1989; Shakhimardanov 2015). What they
// need depends on the drivers that a query gives, so they are made for each query.
//
//   outward  poses, velocities, accelerations without joint accelerations; where drivers act
//   inward   articulated inertias; the effect of each driver and of each unit constraint force on
//            every joint; at the root, the magnitudes of the constraint forces
//   outward  the joint accelerations
// Where some joints follow others, factors of the mass matrix take the place of articulated
// inertias (coupled_drives.h).
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

// steps_coupled_effects.cpp
Step held_forces_step(const MotionDrivers& drivers);
Step coupled_effects_step(const MotionDrivers& drivers);
Step coupled_acceleration_step(const MotionDrivers& drivers);
Step coupled_driver_acceleration_step(const MotionDrivers& drivers);

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
// What steps need that add up all drivers: these, and where there are any the magnitudes of the
// constraint forces and what weighs the drivers.
std::vector<std::string> with_weights(std::vector<std::string> needs, const MotionDrivers& drivers);

// All that these drivers call for; empty when they call for none. They come before other steps that
// give the same. `coupled`: whether some joint follows another.
std::vector<Step> hybrid_steps(const MotionDrivers& drivers, bool coupled);

}  // namespace sinew::synthesis
