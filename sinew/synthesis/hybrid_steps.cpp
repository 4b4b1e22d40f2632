#include "sinew/synthesis/hybrid_steps.h"

namespace sinew::synthesis {

std::vector<Step> hybrid_steps(const MotionDrivers& drivers, bool coupled) {
  if (!drivers.any) return {};
  std::vector<Step> steps;
  const bool constrained = !drivers.constraints.empty();
  if (constrained) {
    steps.push_back(constraint_wrench_step());
    steps.push_back(constraint_bias_step());
    steps.push_back(constraint_lever_step());
  }
  if (coupled) {
    steps.push_back(held_forces_step(drivers));
    steps.push_back(coupled_effects_step(drivers));
  } else {
    steps.push_back(driver_effects_step(drivers));
  }
  if (constrained) steps.push_back(constraint_magnitudes_step());
  if (drivers.limited != kNoDriver) steps.push_back(driver_scale_step(drivers));
  if (constrained) steps.push_back(total_magnitudes_step(drivers));
  if (coupled) {
    steps.push_back(coupled_acceleration_step(drivers));
    steps.push_back(coupled_driver_acceleration_step(drivers));
  } else {
    steps.push_back(constrained_drive_step(drivers));
    steps.push_back(constrained_acceleration_step());
    steps.push_back(driver_acceleration_step(drivers));
  }
  if (constrained) steps.push_back(constraint_force_step());
  steps.push_back(control_force_step(drivers));
  return steps;
}

}  // namespace sinew::synthesis
