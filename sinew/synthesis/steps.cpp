#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

std::vector<Step> make_steps() {
  std::vector<Step> list = {
      joint_pose_step(),
      pose_step(),
      frame_pose_step(),
      joint_velocity_step(),
      velocity_step(),
      frame_twist_step(false),
      gravity_step(),
      joint_acceleration_step(Motion::kFull),
      acceleration_step(Motion::kFull),
      acceleration_step(Motion::kBias),
      acceleration_step(Motion::kRest),
      frame_acceleration_step(),
      inertia_step(),
      external_wrench_step(),
      external_wrench_from_base_step(),
      force_share_step(),
      own_wrench_step(Motion::kFull),
      own_wrench_step(Motion::kBias),
      own_wrench_step(Motion::kRest),
      wrench_step(Motion::kFull),
      wrench_step(Motion::kBias),
      wrench_step(Motion::kRest),
      joint_wrench_step(),
      joint_force_step(Motion::kFull),
      joint_force_step(Motion::kBias),
      joint_force_step(Motion::kRest),
      own_articulated_inertia_step(),
      articulated_inertia_step(),
      drive_with_bias_step(),
      drive_step(),
      forward_dynamics_step(),
      composite_inertia_step(),
      total_inertia_step(),
      mass_matrix_step(),
      cholesky_step(),
      mass_matrix_decomposition_step(),
      forward_dynamics_by_decomposition_step(),
      own_momentum_step(),
      momentum_step(),
      kinetic_energy_step(),
      potential_energy_step(),
      center_of_mass_step(),
      center_of_mass_velocity_step(),
      center_of_mass_jacobian_step(),
      centroidal_momentum_step(),
      centroidal_momentum_matrix_step(),
      jacobian_step(),
  };
  for (const Step& step : between_steps()) list.push_back(step);
  return list;
}

}  // namespace

const std::vector<Step>& steps() {
  static const std::vector<Step> list = make_steps();
  return list;
}

std::span<const Step> steps_for(bool coupled) {
  static const std::vector<Step> list = [] {
    std::vector<Step> some;
    for (const Step& step : steps())
      if (!step.takes_joints_one_by_one) some.push_back(step);
    return some;
  }();
  return coupled ? list : steps();
}

const Step* find_step(std::string_view name) {
  for (const Step& step : steps())
    if (step.name == name) return &step;
  return nullptr;
}

}  // namespace sinew::synthesis
