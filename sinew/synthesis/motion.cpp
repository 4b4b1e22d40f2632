#include "sinew/synthesis/motion.h"

namespace sinew::synthesis {

std::string slot_of(Motion motion, std::string_view slot) {
  std::string_view prefix;
  switch (motion) {
    case Motion::kFull:
      break;
    case Motion::kBias:
      prefix = "bias-";
      break;
    case Motion::kRest:
      prefix = "gravity-";
      break;
    case Motion::kDriven:
      prefix = "driven-";
      break;
    case Motion::kVelocity:
      prefix = "velocity-";
      break;
  }
  return std::string(prefix) + std::string(slot);
}

std::string phrase_of(Motion motion) {
  switch (motion) {
    case Motion::kFull:
      break;
    case Motion::kBias:
      return " without joint accelerations";
    case Motion::kRest:
      return " at rest";
    case Motion::kDriven:
      return " by joint accelerations alone";
    case Motion::kVelocity:
      return " by velocities alone";
  }
  return "";
}

}  // namespace sinew::synthesis
