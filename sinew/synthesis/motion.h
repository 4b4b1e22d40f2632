// Accelerations and the forces that go with them come in several kinds, each with slots of its own
// on the blackboard.
#pragma once

#include <string>
#include <string_view>

namespace sinew::synthesis {

enum class Motion {
  kFull,  // as it is
  kBias,  // with the same velocities and no joint accelerations
  kRest,  // without velocities and joint accelerations: only gravity acts
};

// "body-acceleration", "bias-body-acceleration", "gravity-body-acceleration"
std::string slot_of(Motion motion, std::string_view slot);
// For explanations: "", " without joint accelerations", " at rest"
std::string phrase_of(Motion motion);

}  // namespace sinew::synthesis
