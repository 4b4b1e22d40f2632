#include "sinew/algorithm/quantities.h"

#include <algorithm>
#include <array>

namespace sinew::algorithm {
namespace {

constexpr std::uint8_t bit(Attribute attribute) {
  return static_cast<std::uint8_t>(1u << static_cast<unsigned>(attribute));
}
constexpr std::uint8_t kOf = bit(Attribute::kOf), kWrt = bit(Attribute::kWrt),
                       kSeen = bit(Attribute::kSeenBy), kReference = bit(Attribute::kReference);
constexpr std::uint8_t kPose = kOf | kWrt, kJoint = kOf | kWrt | kSeen,
                       kTwist = kOf | kWrt | kReference | kSeen, kAt = kOf | kReference | kSeen,
                       kNone = 0;

constexpr std::array kQuantities = {
    Quantity{"pose", 12, "UNITLESS M", "", kPose},
    Quantity{"velocity-twist", 6, "RAD-PER-SEC M-PER-SEC", "", kTwist},
    Quantity{"acceleration-twist", 6, "RAD-PER-SEC2 M-PER-SEC2", "", kTwist},
    Quantity{"wrench", 6, "N-M N", "", kAt},
    Quantity{"rigid-body-inertia", 10, "KiloGM M-KiloGM KiloGM-M2", "", kAt},
    Quantity{"articulated-body-inertia", 21, "KiloGM-M2 M-KiloGM KiloGM", "", kAt},
    Quantity{"joint-position", 1, "RAD", "M", kJoint},
    Quantity{"joint-velocity", 1, "RAD-PER-SEC", "M-PER-SEC", kJoint},
    Quantity{"joint-acceleration", 1, "RAD-PER-SEC2", "M-PER-SEC2", kJoint},
    Quantity{"joint-force", 1, "N-M", "N", kJoint},
    // The joint between the world and a floating base; seen from the base.
    Quantity{"floating-position", 7, "M UNITLESS", "", kJoint},
    Quantity{"floating-velocity", 6, "RAD-PER-SEC M-PER-SEC", "", kJoint},
    Quantity{"floating-acceleration", 6, "RAD-PER-SEC2 M-PER-SEC2", "", kJoint},
    Quantity{"floating-force", 6, "N-M N", "", kJoint},
    // A joint between two bodies that leaves all turns free; seen from the successor.
    Quantity{"spherical-position", 4, "UNITLESS", "", kJoint},
    Quantity{"spherical-velocity", 3, "RAD-PER-SEC", "", kJoint},
    Quantity{"spherical-acceleration", 3, "RAD-PER-SEC2", "", kJoint},
    // The numbers of a joint with several degrees of freedom, or of all joints, in their order: of
    // turns and of slides.
    Quantity{"joint-positions", 0, "RAD M", "", kNone},
    Quantity{"joint-velocities", 0, "RAD-PER-SEC M-PER-SEC", "", kNone},
    Quantity{"joint-accelerations", 0, "RAD-PER-SEC2 M-PER-SEC2", "", kNone},
    Quantity{"joint-forces", 0, "N-M N", "", kNone},
    // How some numbers follow from others (operators_joints.cpp); belongs to what follows.
    Quantity{"coordinate-map", 0, "UNITLESS", "", kJoint},
    Quantity{"rotor-inertia", 1, "KiloGM-M2", "KiloGM", kNone},
    Quantity{"cholesky-factor", 0, "UNITLESS", "", kNone},
    Quantity{"mass-matrix-decomposition", 0, "KiloGM M-KiloGM KiloGM-M2", "", kNone},
    // Of a revolute joint: rotation, and metres for each radian; of a prismatic one the other
    // units.
    Quantity{"jacobian-column", 6, "UNITLESS M", "PER-M UNITLESS", kTwist},
    Quantity{"jacobian-block", 36, "UNITLESS M", "", kTwist},  // six columns, one after the other
    Quantity{"jacobian", 0, "UNITLESS M", "", kTwist},
    // Of a body that flows past a frame that stands still.
    Quantity{"spatial-acceleration-twist", 6, "RAD-PER-SEC2 M-PER-SEC2", "", kTwist},
    Quantity{"position-and-quaternion", 7, "M UNITLESS", "", kPose},
    Quantity{"quaternion-column", 7, "M UNITLESS", "UNITLESS PER-M", kPose},
    Quantity{"quaternion-block", 42, "M UNITLESS", "", kPose},
    Quantity{"analytic-jacobian", 0, "M UNITLESS", "", kPose},
    Quantity{"momentum", 6, "KiloGM-M2-PER-SEC KiloGM-M-PER-SEC", "", kAt},
    Quantity{"momentum-column", 6, "KiloGM-M2 M-KiloGM", "M-KiloGM KiloGM", kAt},
    Quantity{"momentum-block", 36, "KiloGM-M2 M-KiloGM", "", kAt},
    Quantity{"momentum-matrix", 0, "KiloGM-M2 M-KiloGM", "", kAt},
    Quantity{"energy", 1, "J", "", kNone},
    Quantity{"position-vector", 3, "M", "", kJoint},
    // Of gravity: of what falls freely, with respect to the base.
    Quantity{"linear-acceleration", 3, "M-PER-SEC2", "", kJoint},
    Quantity{"linear-velocity", 3, "M-PER-SEC", "", kJoint},
    Quantity{"linear-jacobian-column", 3, "M", "UNITLESS", kJoint},
    Quantity{"linear-jacobian-block", 18, "M UNITLESS", "", kJoint},
    Quantity{"linear-jacobian", 0, "M UNITLESS", "", kJoint},
    // Of hybrid dynamics: force times acceleration; how many times a unit effect (of a unit
    // constraint force, of a driver).
    Quantity{"acceleration-energy", 1, "N-M-PER-SEC2", "", kNone},
    Quantity{"magnitude", 1, "UNITLESS", "", kNone},
    Quantity{"constraint-magnitudes", 0, "UNITLESS", "", kNone},
    // Of tasks and their controllers: one number of any unit; 1 or 0; a direction, and one that is
    // a body's line of action; the error of a pose and what an impedance makes of it.
    Quantity{"signal", 1, "", "", kNone},
    Quantity{"flag", 1, "UNITLESS", "", kNone},
    Quantity{"direction", 3, "UNITLESS", "", kSeen},
    Quantity{"line", 3, "UNITLESS", "", kAt},
    Quantity{"pose-error", 6, "RAD M", "", kTwist},
    Quantity{"spatial-stiffness", 6, "N-M-PER-RAD N-PER-M", "", kSeen},
    Quantity{"spatial-damping", 6, "N-M-SEC-PER-RAD N-SEC-PER-M", "", kSeen},
    Quantity{"mass-matrix", 0, "KiloGM M-KiloGM KiloGM-M2", "", kNone},
};

}  // namespace

std::string_view to_string(Attribute attribute) {
  constexpr std::array<std::string_view, kAttributes> names = {"of", "with-respect-to",
                                                               "reference-point", "seen-by"};
  return names[static_cast<std::size_t>(attribute)];
}

std::span<const Quantity> quantities() { return kQuantities; }

const Quantity* find_quantity(std::string_view name) {
  const auto* found = std::find_if(kQuantities.begin(), kQuantities.end(),
                                   [&](const Quantity& quantity) { return quantity.name == name; });
  return found == kQuantities.end() ? nullptr : found;
}

}  // namespace sinew::algorithm
