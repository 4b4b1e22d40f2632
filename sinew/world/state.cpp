#include "sinew/world/state.h"

namespace sinew::world {

std::uint32_t size_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::kPose:
      return 7;
    case Quantity::kTwist:
    case Quantity::kAcceleration:
      return 6;
    case Quantity::kJointPosition:
    case Quantity::kJointVelocity:
    case Quantity::kJointAcceleration:
      return 1;
    case Quantity::kOther:
      return 0;
  }
  return 0;
}

std::string_view to_string(Quantity quantity) {
  static constexpr std::string_view kNames[] = {
      "pose", "twist", "acceleration", "joint-position", "joint-velocity", "joint-acceleration",
      "other"};
  return kNames[static_cast<std::size_t>(quantity)];
}

std::string_view to_string(ElementKind kind) {
  static constexpr std::string_view kNames[] = {"nothing", "frame", "object", "relation",
                                                "measurement"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace sinew::world
