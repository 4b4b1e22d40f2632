// Forward kinematics and inverse dynamics on a normalised tree, as plain as they can be: dense, in
// world coordinates, one body after the other (Newton and Euler; Luh, Walker and Paul 1980). The
// tests' own measure of whether a tree is right.
#pragma once

#include <cmath>
#include <vector>

#include "sinew/model/tree.h"

namespace sinew::model::test {

struct Motion {
  std::vector<double> q, qd, qdd;  // in the order of tree.joints
};

struct Dynamics {
  std::vector<Pose> poses;     // of each body's frame in the root's
  std::vector<double> forces;  // of each joint
};

inline Dynamics newton_euler(const Tree& tree, const Motion& motion) {
  const std::size_t n = tree.bodies.size();
  Dynamics result;
  result.poses.resize(n);
  result.forces.resize(tree.joints.size());
  std::vector<Vector3> w(n), al(n), a(n);  // of each frame's origin, seen from the root
  result.poses[0] = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
  al[0] = tree.base_acceleration.angular;
  a[0] = tree.base_acceleration.linear;
  for (std::size_t k = 0; k < tree.joints.size(); ++k) {
    const Tree::Joint& joint = tree.joints[k];
    const std::size_t p = joint.predecessor, b = joint.successor;
    const bool turns = joint.kind == JointKind::kRevolute;
    const double s = std::sin(motion.q[k]), c = std::cos(motion.q[k]);
    const Pose moved = turns ? Pose{{c, -s, 0, s, c, 0, 0, 0, 1}, {0, 0, 0}}
                             : Pose{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, motion.q[k]}};
    result.poses[b] = math::compose(math::compose(result.poses[p], joint.placement), moved);
    const Matrix3& R = result.poses[b].R;
    const Vector3 z = {R.xz, R.yz, R.zz};
    const Vector3 r = result.poses[b].p - result.poses[p].p;
    const Vector3 carried = a[p] + cross(al[p], r) + cross(w[p], cross(w[p], r));
    const double qd = motion.qd[k], qdd = motion.qdd[k];
    if (turns) {
      w[b] = w[p] + qd * z;
      al[b] = al[p] + qdd * z + cross(w[p], qd * z);
      a[b] = carried;
    } else {
      w[b] = w[p];
      al[b] = al[p];
      a[b] = carried + qdd * z + 2.0 * cross(w[p], qd * z);
    }
  }
  std::vector<Vector3> f(n), m(n);
  for (std::size_t b = n; b-- > 1;) {
    const Tree::Joint& joint = tree.joints[b - 1];
    const Tree::Body& body = tree.bodies[b];
    const Matrix3& R = result.poses[b].R;
    if (body.has_inertia) {
      const RigidBodyInertia& I = body.inertia;
      const auto rotate = [&](const Vector3& v) {  // I v, seen from the root
        const Vector3 l = transpose_times(R, v);
        const auto& S = I.rotational;
        return R * Vector3{S.xx * l.x + S.xy * l.y + S.xz * l.z,
                           S.xy * l.x + S.yy * l.y + S.yz * l.z,
                           S.xz * l.x + S.yz * l.y + S.zz * l.z};
      };
      const Vector3 h = R * I.first_moment;
      f[b] = f[b] + I.mass * a[b] + cross(al[b], h) + cross(w[b], cross(w[b], h));
      m[b] = m[b] + rotate(al[b]) + cross(w[b], rotate(w[b])) + cross(h, a[b]);
    }
    const Vector3 z = {R.xz, R.yz, R.zz};
    result.forces[b - 1] = joint.kind == JointKind::kRevolute ? dot(z, m[b]) : dot(z, f[b]);
    const std::size_t p = joint.predecessor;
    f[p] = f[p] + f[b];
    m[p] = m[p] + m[b] + cross(result.poses[b].p - result.poses[p].p, f[b]);
  }
  return result;
}

// The pose of any frame of the tree in the root's frame.
inline Pose pose_of(const Tree& tree, const Dynamics& result, Id frame) {
  const Tree::Frame* f = tree.find_frame(frame);
  return math::compose(result.poses.at(f->body), f->placement);
}

}  // namespace sinew::model::test
