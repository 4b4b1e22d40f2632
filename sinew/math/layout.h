// How the values of `math` lie in memory as consecutive numbers: the layouts of
// docs/architecture.md.
//   Layout<T>::kSize, Layout<T>::load(const S*), Layout<T>::store(const T&, S*)
#pragma once

#include <cstdint>

#include "sinew/math/articulated_inertia.h"
#include "sinew/math/compound_joint.h"
#include "sinew/math/control.h"
#include "sinew/math/floating.h"
#include "sinew/math/inertia.h"
#include "sinew/math/jacobian.h"
#include "sinew/math/momentum.h"
#include "sinew/math/pose.h"
#include "sinew/math/relative_motion.h"
#include "sinew/math/twist.h"
#include "sinew/math/wrench.h"

namespace sinew::math {

// A scalar is one number.
template <typename T>
struct Layout {
  static constexpr std::uint32_t kSize = 1;
  static T load(const T* at) { return *at; }
  static void store(const T& value, T* at) { *at = value; }
};

// Row-major 3x4 [R p].
template <typename S>
struct Layout<Pose<S>> {
  static constexpr std::uint32_t kSize = 12;
  static Pose<S> load(const S* at) {
    return {{at[0], at[1], at[2], at[4], at[5], at[6], at[8], at[9], at[10]},
            {at[3], at[7], at[11]}};
  }
  static void store(const Pose<S>& X, S* at) {
    at[0] = X.R.xx, at[1] = X.R.xy, at[2] = X.R.xz, at[3] = X.p.x;
    at[4] = X.R.yx, at[5] = X.R.yy, at[6] = X.R.yz, at[7] = X.p.y;
    at[8] = X.R.zx, at[9] = X.R.zy, at[10] = X.R.zz, at[11] = X.p.z;
  }
};

// Angular (moment) first.
template <typename S>
struct Layout<VelocityTwist<S>> {
  static constexpr std::uint32_t kSize = 6;
  static VelocityTwist<S> load(const S* at) {
    return {{at[0], at[1], at[2]}, {at[3], at[4], at[5]}};
  }
  static void store(const VelocityTwist<S>& V, S* at) {
    at[0] = V.angular.x, at[1] = V.angular.y, at[2] = V.angular.z;
    at[3] = V.linear.x, at[4] = V.linear.y, at[5] = V.linear.z;
  }
};

template <typename S>
struct Layout<AccelerationTwist<S>> {
  static constexpr std::uint32_t kSize = 6;
  static AccelerationTwist<S> load(const S* at) {
    return {{at[0], at[1], at[2]}, {at[3], at[4], at[5]}};
  }
  static void store(const AccelerationTwist<S>& A, S* at) {
    at[0] = A.angular.x, at[1] = A.angular.y, at[2] = A.angular.z;
    at[3] = A.linear.x, at[4] = A.linear.y, at[5] = A.linear.z;
  }
};

template <typename S>
struct Layout<Wrench<S>> {
  static constexpr std::uint32_t kSize = 6;
  static Wrench<S> load(const S* at) { return {{at[0], at[1], at[2]}, {at[3], at[4], at[5]}}; }
  static void store(const Wrench<S>& W, S* at) {
    at[0] = W.moment.x, at[1] = W.moment.y, at[2] = W.moment.z;
    at[3] = W.force.x, at[4] = W.force.y, at[5] = W.force.z;
  }
};

template <typename S>
struct Layout<PoseError<S>> {
  static constexpr std::uint32_t kSize = 6;
  static PoseError<S> load(const S* at) { return {{at[0], at[1], at[2]}, {at[3], at[4], at[5]}}; }
  static void store(const PoseError<S>& e, S* at) {
    at[0] = e.angular.x, at[1] = e.angular.y, at[2] = e.angular.z;
    at[3] = e.linear.x, at[4] = e.linear.y, at[5] = e.linear.z;
  }
};

template <typename S>
struct Layout<SpatialGains<S>> {
  static constexpr std::uint32_t kSize = 6;
  static SpatialGains<S> load(const S* at) {
    return {{at[0], at[1], at[2]}, {at[3], at[4], at[5]}};
  }
};

// m, m c (3), Ixx Ixy Ixz Iyy Iyz Izz.
template <typename S>
struct Layout<RigidBodyInertia<S>> {
  static constexpr std::uint32_t kSize = 10;
  static RigidBodyInertia<S> load(const S* at) {
    return {at[0], {at[1], at[2], at[3]}, {at[4], at[5], at[6], at[7], at[8], at[9]}};
  }
  static void store(const RigidBodyInertia<S>& I, S* at) {
    at[0] = I.mass;
    at[1] = I.first_moment.x, at[2] = I.first_moment.y, at[3] = I.first_moment.z;
    at[4] = I.rotational.xx, at[5] = I.rotational.xy, at[6] = I.rotational.xz;
    at[7] = I.rotational.yy, at[8] = I.rotational.yz, at[9] = I.rotational.zz;
  }
};

// The quaternion x y z w.
template <typename S>
struct Layout<SphericalPosition<S>> {
  static constexpr std::uint32_t kSize = 4;
  static SphericalPosition<S> load(const S* at) { return {{at[0], at[1], at[2]}, at[3]}; }
  static void store(const SphericalPosition<S>& q, S* at) {
    at[0] = q.v.x, at[1] = q.v.y, at[2] = q.v.z, at[3] = q.w;
  }
};

// x y z, then the quaternion x y z w.
template <typename S>
struct Layout<FloatingPosition<S>> {
  static constexpr std::uint32_t kSize = 7;
  static FloatingPosition<S> load(const S* at) {
    return {{at[0], at[1], at[2]}, {at[3], at[4], at[5]}, at[6]};
  }
  static void store(const FloatingPosition<S>& q, S* at) {
    at[0] = q.p.x, at[1] = q.p.y, at[2] = q.p.z;
    at[3] = q.v.x, at[4] = q.v.y, at[5] = q.v.z, at[6] = q.w;
  }
};

// One column after the other.
template <typename S>
struct Layout<JacobianBlock<S>> {
  static constexpr std::uint32_t kSize = 36;
  static JacobianBlock<S> load(const S* at) {
    JacobianBlock<S> block;
    for (int k = 0; k < 6; ++k) block.columns[k] = Layout<VelocityTwist<S>>::load(at + 6 * k);
    return block;
  }
  static void store(const JacobianBlock<S>& block, S* at) {
    for (int k = 0; k < 6; ++k) Layout<VelocityTwist<S>>::store(block.columns[k], at + 6 * k);
  }
};

// Angular first.
template <typename S>
struct Layout<Momentum<S>> {
  static constexpr std::uint32_t kSize = 6;
  static Momentum<S> load(const S* at) { return {{at[0], at[1], at[2]}, {at[3], at[4], at[5]}}; }
  static void store(const Momentum<S>& P, S* at) {
    at[0] = P.angular.x, at[1] = P.angular.y, at[2] = P.angular.z;
    at[3] = P.linear.x, at[4] = P.linear.y, at[5] = P.linear.z;
  }
};

template <typename S>
struct Layout<Vector3<S>> {
  static constexpr std::uint32_t kSize = 3;
  static Vector3<S> load(const S* at) { return {at[0], at[1], at[2]}; }
  static void store(const Vector3<S>& v, S* at) { at[0] = v.x, at[1] = v.y, at[2] = v.z; }
};

// One column after the other.
template <typename S>
struct Layout<LinearBlock<S>> {
  static constexpr std::uint32_t kSize = 18;
  static LinearBlock<S> load(const S* at) {
    LinearBlock<S> block;
    for (int k = 0; k < 6; ++k) block.columns[k] = Layout<Vector3<S>>::load(at + 3 * k);
    return block;
  }
  static void store(const LinearBlock<S>& block, S* at) {
    for (int k = 0; k < 6; ++k) Layout<Vector3<S>>::store(block.columns[k], at + 3 * k);
  }
};

// One column after the other.
template <typename S>
struct Layout<MomentumBlock<S>> {
  static constexpr std::uint32_t kSize = 36;
  static MomentumBlock<S> load(const S* at) {
    MomentumBlock<S> block;
    for (int k = 0; k < 6; ++k) block.columns[k] = Layout<Momentum<S>>::load(at + 6 * k);
    return block;
  }
  static void store(const MomentumBlock<S>& block, S* at) {
    for (int k = 0; k < 6; ++k) Layout<Momentum<S>>::store(block.columns[k], at + 6 * k);
  }
};

// One column after the other.
template <typename S>
struct Layout<QuaternionBlock<S>> {
  static constexpr std::uint32_t kSize = 42;
  static QuaternionBlock<S> load(const S* at) {
    QuaternionBlock<S> block;
    for (int k = 0; k < 6; ++k) block.columns[k] = Layout<FloatingPosition<S>>::load(at + 7 * k);
    return block;
  }
  static void store(const QuaternionBlock<S>& block, S* at) {
    for (int k = 0; k < 6; ++k) Layout<FloatingPosition<S>>::store(block.columns[k], at + 7 * k);
  }
};

// J (xx xy xz yy yz zz), H row by row, M (as J).
template <typename S>
struct Layout<ArticulatedInertia<S>> {
  static constexpr std::uint32_t kSize = 21;
  static ArticulatedInertia<S> load(const S* at) {
    return {{at[0], at[1], at[2], at[3], at[4], at[5]},
            {at[6], at[7], at[8], at[9], at[10], at[11], at[12], at[13], at[14]},
            {at[15], at[16], at[17], at[18], at[19], at[20]}};
  }
  static void store(const ArticulatedInertia<S>& I, S* at) {
    at[0] = I.J.xx, at[1] = I.J.xy, at[2] = I.J.xz, at[3] = I.J.yy, at[4] = I.J.yz, at[5] = I.J.zz;
    at[6] = I.H.xx, at[7] = I.H.xy, at[8] = I.H.xz, at[9] = I.H.yx, at[10] = I.H.yy;
    at[11] = I.H.yz, at[12] = I.H.zx, at[13] = I.H.zy, at[14] = I.H.zz;
    at[15] = I.M.xx, at[16] = I.M.xy, at[17] = I.M.xz, at[18] = I.M.yy, at[19] = I.M.yz;
    at[20] = I.M.zz;
  }
};

}  // namespace sinew::math
