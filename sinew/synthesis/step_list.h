// Makers of the steps, one for each row of the list in steps.cpp.
#pragma once

#include "sinew/synthesis/motion.h"
#include "sinew/synthesis/step.h"

namespace sinew::synthesis {

// steps_position.cpp
Step joint_pose_step();
Step pose_step();

// steps_velocity.cpp
Step joint_velocity_step();
Step velocity_step();

// steps_acceleration.cpp
Step gravity_step();
Step joint_acceleration_step(Motion motion);
Step acceleration_step(Motion motion);

// steps_force.cpp
Step inertia_step();
Step own_wrench_step(Motion motion);
Step wrench_step(Motion motion);
Step joint_force_step(Motion motion);

// steps_external_wrench.cpp
Step external_wrench_step();
Step external_wrench_from_base_step();
Step force_share_step();

// steps_joint_wrench.cpp
Step joint_wrench_step();

// steps_frames.cpp: of the frames that are asked for
Step frame_pose_step();
Step frame_twist_step(bool by_jacobian);
Step frame_acceleration_step();

// steps_forward_dynamics.cpp
Step own_articulated_inertia_step();
Step articulated_inertia_step();
Step drive_step();
Step drive_with_bias_step();
Step forward_dynamics_step();

// steps_mass_matrix.cpp
Step composite_inertia_step();
Step total_inertia_step();
Step mass_matrix_step();

// steps_mass.cpp
Step own_momentum_step();
Step momentum_step();
Step center_of_mass_step();
Step center_of_mass_velocity_step();
Step center_of_mass_jacobian_step();
Step centroidal_momentum_step();
Step centroidal_momentum_matrix_step();

// steps_energy.cpp
Step kinetic_energy_step();
Step potential_energy_step();

// steps_factors.cpp
Step cholesky_step();
Step mass_matrix_decomposition_step();
Step forward_dynamics_by_decomposition_step();

// steps_jacobian.cpp
Step jacobian_step();

// steps_between.cpp: between any two frames
std::vector<Step> between_steps();

}  // namespace sinew::synthesis
