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
  // Where several of these are asked at once, their parts cost less (steps_together.h):
  kDriven,    // with joint accelerations alone: no velocities, no gravity
  kVelocity,  // with velocities alone: no joint accelerations, no gravity; external wrenches help
};

// Whether nothing moves at this moment, so that velocities have no effect.
inline bool at_rest(Motion motion) { return motion == Motion::kRest || motion == Motion::kDriven; }
// Whether gravity accelerates the root.
inline bool falls(Motion motion) {
  return motion != Motion::kDriven && motion != Motion::kVelocity;
}
// Whether joints accelerate as they are told to.
inline bool is_driven(Motion motion) {
  return motion == Motion::kFull || motion == Motion::kDriven;
}

// "body-acceleration", "bias-body-acceleration", "gravity-body-acceleration"
std::string slot_of(Motion motion, std::string_view slot);
// For explanations: "", " without joint accelerations", " at rest"
std::string phrase_of(Motion motion);

}  // namespace sinew::synthesis
