// What all peers read from a URDF.
#pragma once

#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <stdexcept>

#include "peer.h"

namespace sinew::peers {

// MuJoCo and DART want some mass [kg] and inertia [kg m^2] of every moving body; this much is
// beyond what any comparison can see.
inline constexpr double kLeastMass = 1e-14;

inline urdf::ModelInterfaceSharedPtr parse_urdf(const std::string& text) {
  const auto model = urdf::parseURDF(text);
  if (!model) throw std::runtime_error("urdfdom cannot read the URDF");
  return model;
}

inline bool moves(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS ||
         joint.type == urdf::Joint::PRISMATIC;
}

// x y z w
inline std::array<double, 4> quaternion(const urdf::Rotation& rotation) {
  std::array<double, 4> q{};
  rotation.getQuaternion(q[0], q[1], q[2], q[3]);
  return q;
}

}  // namespace sinew::peers
