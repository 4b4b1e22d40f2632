#include "sinew/synthesis/motion.h"

namespace sinew::synthesis {

std::string slot_of(Motion motion, std::string_view slot) {
  std::string prefix = motion == Motion::kBias   ? "bias-"
                       : motion == Motion::kRest ? "gravity-"
                                                 : "";
  return prefix + std::string(slot);
}

std::string phrase_of(Motion motion) {
  return motion == Motion::kBias   ? " without joint accelerations"
         : motion == Motion::kRest ? " at rest"
                                   : "";
}

}  // namespace sinew::synthesis
