#include "sinew/synthesis/asked.h"

#include <algorithm>

namespace sinew::synthesis {
namespace {

constexpr AskedQuantity kAsked[] = {
    {"pose", Element::kFrame, "frame-pose", "pose", true, false, "pose-between"},
    {"twist", Element::kFrame, "twist", "twist", true, false, "twist-between"},
    {"acceleration-twist", Element::kFrame, "acceleration-twist", "acceleration-twist", true, false,
     "acceleration-between"},
    {"jacobian-rate-times-velocity", Element::kFrame, "jacobian-rate-times-velocity",
     "jacobian-rate-times-velocity", true, false, "jacobian-rate-times-velocity"},
    {"analytic-jacobian", Element::kFrame, "analytic-jacobian", "analytic-jacobian", true, false,
     "analytic-jacobian"},
    {"position-and-quaternion", Element::kFrame, "position-and-quaternion",
     "position-and-quaternion", true, false, "position-and-quaternion"},
    {"joint-force", Element::kJoint, "force", "force", true, true},
    {"joint-force-share", Element::kJoint, "force-share", "force-share", true, true},
    {"joint-wrench", Element::kJoint, "joint-wrench", "joint-wrench", false, true},
    {"bias-force", Element::kJoint, "bias-force", "bias-force", true, true},
    {"joint-acceleration", Element::kJoint, "acceleration", "acceleration", true, true},
    {"mass-matrix", Element::kRobot, "mass-matrix", "mass-matrix", true, true},
    {"jacobian", Element::kFrame, "jacobian", "jacobian", true, false, "jacobian-between"},
    {"center-of-mass", Element::kRobot, "center-of-mass", "center-of-mass", false, true},
    {"center-of-mass-velocity", Element::kRobot, "center-of-mass-velocity",
     "center-of-mass-velocity", false, true},
    {"center-of-mass-jacobian", Element::kRobot, "center-of-mass-jacobian",
     "center-of-mass-jacobian", false, true},
    {"momentum", Element::kRobot, "momentum", "momentum", false, true},
    {"centroidal-momentum", Element::kRobot, "centroidal-momentum", "centroidal-momentum", false,
     true},
    {"centroidal-momentum-matrix", Element::kRobot, "centroidal-momentum-matrix",
     "centroidal-momentum-matrix", false, true},
    {"kinetic-energy", Element::kRobot, "kinetic-energy", "kinetic-energy", false, true},
    {"potential-energy", Element::kRobot, "potential-energy", "potential-energy", false, true},
    {"control-force", Element::kJoint, "control-force", "control-force", true, true},
    {"gravity-force", Element::kJoint, "gravity-force", "gravity-force", true, true},
    // Hybrid dynamics.
    {"constraint-magnitude", Element::kConstraint, "constraint-magnitude", "constraint-magnitude",
     true, true},
    {"constraint-force", Element::kJoint, "constraint-force", "constraint-force", true, true},
    {"control-force", Element::kJoint, "control-force", "control-force", true, true},
    {"driver-acceleration", Element::kDriverJoint, "driver-acceleration", "driver-acceleration",
     true, true},
    {"driver-scale", Element::kLimited, "driver-scale", "driver-scale", true, true},
};

constexpr GivenQuantity kGiven[] = {
    {"joint-position", Element::kJoint, "position"},
    {"joint-velocity", Element::kJoint, "velocity"},
    {"joint-acceleration", Element::kJoint, "acceleration"},
    {"joint-force", Element::kJoint, "force"},
    {"gravity", Element::kRobot, "base-acceleration"},
    {"external-wrench", Element::kFrame, "wrench"},
    {"acceleration-constraint", Element::kFrame, "acceleration-energy"},
};

template <typename Rows>
auto* find(const Rows& rows, std::string_view name) {
  const auto* end = std::end(rows);
  const auto* found =
      std::find_if(std::begin(rows), end, [&](const auto& row) { return row.name == name; });
  return found == end ? nullptr : found;
}

}  // namespace

std::span<const AskedQuantity> asked_quantities() { return kAsked; }
std::span<const GivenQuantity> given_quantities() { return kGiven; }
const AskedQuantity* find_asked(std::string_view name) { return find(kAsked, name); }
const GivenQuantity* find_given(std::string_view name) { return find(kGiven, name); }

const GivenQuantity* find_given_for(std::string_view slot) {
  for (const GivenQuantity& row : kGiven)
    if (row.slot == slot) return &row;
  return nullptr;
}

}  // namespace sinew::synthesis
