// What urdfdom reads, as KDL has it.
#pragma once

#include <kdl/frames.hpp>
#include <kdl/rigidbodyinertia.hpp>

#include "urdf_model.h"

namespace sinew::peers {

inline KDL::Frame kdl_frame(const urdf::Pose& pose) {
  const auto q = quaternion(pose.rotation);
  return {KDL::Rotation::Quaternion(q[0], q[1], q[2], q[3]),
          KDL::Vector(pose.position.x, pose.position.y, pose.position.z)};
}

inline KDL::RigidBodyInertia kdl_inertia(const urdf::Link& link) {
  if (!link.inertial) return KDL::RigidBodyInertia::Zero();
  const urdf::Inertial& i = *link.inertial;
  return kdl_frame(i.origin) *
         KDL::RigidBodyInertia(i.mass, KDL::Vector::Zero(),
                               KDL::RotationalInertia(i.ixx, i.iyy, i.izz, i.ixy, i.ixz, i.iyz));
}

}  // namespace sinew::peers
