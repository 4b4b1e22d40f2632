// The functions of `math` against dense matrices: what a formula says must be what textbook algebra
// gives.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <vector>

#include "sinew/math/articulated_inertia.h"
#include "sinew/math/inertia.h"
#include "sinew/math/joint.h"
#include "sinew/math/pose.h"
#include "sinew/math/twist.h"
#include "sinew/math/wrench.h"

namespace sinew::math {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using EigenMatrix3 = Eigen::Matrix3d;
using EigenVector3 = Eigen::Vector3d;

constexpr double kTolerance = 1e-13;

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double number() { return uniform_(generator_); }
  Vector3<double> vector() { return {number(), number(), number()}; }

  Pose<double> pose() {
    const EigenMatrix3 R =
        Eigen::AngleAxisd(3.0 * number(), EigenVector3::Random().normalized()).toRotationMatrix();
    return {{R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)},
            vector()};
  }
  VelocityTwist<double> velocity() { return {vector(), vector()}; }
  AccelerationTwist<double> acceleration() { return {vector(), vector()}; }
  Wrench<double> wrench() { return {vector(), vector()}; }
  RigidBodyInertia<double> inertia() {
    return {2.0 + number(), vector(), {number(), number(), number(), number(), number(), number()}};
  }

 private:
  std::mt19937 generator_;
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

EigenVector3 dense(const Vector3<double>& v) { return {v.x, v.y, v.z}; }

EigenMatrix3 dense(const Matrix3<double>& M) {
  EigenMatrix3 result;
  result << M.xx, M.xy, M.xz, M.yx, M.yy, M.yz, M.zx, M.zy, M.zz;
  return result;
}

EigenMatrix3 dense(const Symmetric3<double>& M) {
  EigenMatrix3 result;
  result << M.xx, M.xy, M.xz, M.xy, M.yy, M.yz, M.xz, M.yz, M.zz;
  return result;
}

EigenMatrix3 skew(const EigenVector3& v) {
  EigenMatrix3 result;
  result << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return result;
}

template <typename T>
Vector6 stack(const T& top, const T& bottom) {
  Vector6 result;
  result << dense(top), dense(bottom);
  return result;
}

Vector6 dense(const VelocityTwist<double>& V) { return stack(V.angular, V.linear); }
Vector6 dense(const AccelerationTwist<double>& A) { return stack(A.angular, A.linear); }
Vector6 dense(const Wrench<double>& W) { return stack(W.moment, W.force); }

Eigen::Matrix4d homogeneous(const Pose<double>& X) {
  Eigen::Matrix4d result = Eigen::Matrix4d::Identity();
  result.topLeftCorner<3, 3>() = dense(X.R);
  result.topRightCorner<3, 1>() = dense(X.p);
  return result;
}

// Motion of B from motion of A, for frames that are fixed to each other: [R^T 0; -R^T [p]x R^T].
Matrix6 motion_transform(const Pose<double>& X_AB) {
  const EigenMatrix3 Rt = dense(X_AB.R).transpose();
  Matrix6 result = Matrix6::Zero();
  result.topLeftCorner<3, 3>() = Rt;
  result.bottomRightCorner<3, 3>() = Rt;
  result.bottomLeftCorner<3, 3>() = -Rt * skew(dense(X_AB.p));
  return result;
}

Matrix6 dense(const RigidBodyInertia<double>& I) {
  const EigenVector3 h = dense(I.first_moment);
  Matrix6 result;
  result << dense(I.rotational), skew(h), skew(h).transpose(), I.mass * EigenMatrix3::Identity();
  return result;
}

template <typename A, typename B>
void expect_near(const A& a, const B& b) {
  EXPECT_LT((a - b).norm(), kTolerance * (1.0 + b.norm())) << a << "\n\n" << b;
}

class SpatialAlgebra : public testing::TestWithParam<unsigned> {
 protected:
  Random random{GetParam()};
};

TEST_P(SpatialAlgebra, PosesComposeAndInvertAsHomogeneousMatrices) {
  const Pose<double> X_AB = random.pose();
  const Pose<double> X_BC = random.pose();
  expect_near(homogeneous(compose(X_AB, X_BC)), homogeneous(X_AB) * homogeneous(X_BC));
  expect_near(homogeneous(invert(X_AB)), homogeneous(X_AB).inverse());
}

TEST_P(SpatialAlgebra, VelocitiesMoveToDistalFrames) {
  const Pose<double> X_AB = random.pose();
  const VelocityTwist<double> V_A = random.velocity();
  expect_near(dense(transform_to_distal(X_AB, V_A)), motion_transform(X_AB) * dense(V_A));
}

TEST_P(SpatialAlgebra, WrenchesMoveToProximalFramesByTheTransposeSoThatPowerStays) {
  const Pose<double> X_AB = random.pose();
  const Wrench<double> W_B = random.wrench();
  const VelocityTwist<double> V_A = random.velocity();
  const Wrench<double> W_A = transform_to_proximal(X_AB, W_B);
  expect_near(dense(W_A), motion_transform(X_AB).transpose() * dense(W_B));
  EXPECT_NEAR(dense(W_A).dot(dense(V_A)), dense(W_B).dot(dense(transform_to_distal(X_AB, V_A))),
              kTolerance * 10);
}

TEST_P(SpatialAlgebra, AccelerationsOfAttachedFramesAreClassical) {
  const Pose<double> X_AB = random.pose();
  const VelocityTwist<double> V_A = random.velocity();
  const AccelerationTwist<double> A_A = random.acceleration();
  const EigenMatrix3 Rt = dense(X_AB.R).transpose();
  const EigenVector3 w = dense(V_A.angular), al = dense(A_A.angular), p = dense(X_AB.p);
  Vector6 expected;
  expected << Rt * al, Rt * (dense(A_A.linear) + al.cross(p) + w.cross(w.cross(p)));
  expect_near(dense(transform_to_distal_fixed(X_AB, V_A, A_A)), expected);
  const VelocityTwist<double> rest{};
  expect_near(dense(transform_to_distal_at_rest(X_AB, A_A)),
              dense(transform_to_distal_fixed(X_AB, rest, A_A)));
}

TEST_P(SpatialAlgebra, AccelerationsOfMovingFramesAreTheDerivativesOfTheirVelocities) {
  // B moves against A by a joint; the derivative of B's velocity is taken numerically in the
  // inertial frame.
  const Pose<double> X_AF = random.pose();  // A to the joint
  const VelocityTwist<double> V_A = random.velocity();
  const AccelerationTwist<double> A_A = random.acceleration();
  for (const bool revolute : {true, false}) {
    const double q = random.number(), qd = random.number(), qdd = random.number();
    const auto joint = [&](double t) {
      const double q_t = q + qd * t + 0.5 * qdd * t * t;
      return compose(X_AF, revolute ? revolute_pose(q_t) : prismatic_pose(q_t));
    };
    // A's own motion to second order, from the identity: rotation exp(w t + (al) t^2/2), origin
    // likewise.
    const auto frame_A = [&](double t) {
      const EigenVector3 w = dense(V_A.angular) * t + dense(A_A.angular) * (0.5 * t * t);
      Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
      if (w.norm() > 0)
        T.topLeftCorner<3, 3>() = Eigen::AngleAxisd(w.norm(), w.normalized()).matrix();
      T.topRightCorner<3, 1>() = dense(V_A.linear) * t + dense(A_A.linear) * (0.5 * t * t);
      return T;
    };
    const auto origin = [&](double t) -> EigenVector3 {
      return (frame_A(t) * homogeneous(joint(t))).topRightCorner<3, 1>();
    };
    const double step = 1e-4;
    const EigenVector3 a_seen_from_A =
        (origin(step) - 2 * origin(0) + origin(-step)) / (step * step);

    const Pose<double> X_FB = revolute ? revolute_pose(q) : prismatic_pose(q);
    const VelocityTwist<double> V_rel = revolute ? revolute_velocity(qd) : prismatic_velocity(qd);
    const AccelerationTwist<double> A_rel =
        revolute ? revolute_acceleration(qdd) : prismatic_acceleration(qdd);
    const AccelerationTwist<double> A_F = transform_to_distal_fixed(X_AF, V_A, A_A);
    const VelocityTwist<double> V_F = transform_to_distal(X_AF, V_A);
    const AccelerationTwist<double> A_B = add(transform_to_distal(X_FB, V_F, V_rel, A_F), A_rel);
    const EigenMatrix3 R_AB = dense(joint(0).R);
    EXPECT_LT((R_AB * dense(A_B.linear) - a_seen_from_A).norm(), 1e-5);
    // alpha_B = alpha_A + d/dt (R_A omega_rel): the joint's axis turns with A.
    const EigenVector3 w_rel = R_AB * dense(V_rel.angular);
    const EigenVector3 alpha =
        dense(A_A.angular) + dense(V_A.angular).cross(w_rel) + R_AB * dense(A_rel.angular);
    EXPECT_LT((R_AB * dense(A_B.angular) - alpha).norm(), kTolerance * 10);
  }
}

TEST_P(SpatialAlgebra, NewtonEulerIsTheSpatialEquationOfMotion) {
  const RigidBodyInertia<double> I = random.inertia();
  const VelocityTwist<double> V = random.velocity();
  const AccelerationTwist<double> A = random.acceleration();
  // Spatial acceleration is classical acceleration without omega x v (Featherstone 2008, 2.11), and
  // f = I a + v x* I v.
  Vector6 spatial = dense(A);
  spatial.tail<3>() -= dense(V.angular).cross(dense(V.linear));
  const EigenVector3 w = dense(V.angular), v = dense(V.linear);
  Matrix6 cross_force = Matrix6::Zero();
  cross_force.topLeftCorner<3, 3>() = skew(w);
  cross_force.topRightCorner<3, 3>() = skew(v);
  cross_force.bottomRightCorner<3, 3>() = skew(w);
  const Vector6 expected = dense(I) * spatial + cross_force * dense(I) * dense(V);
  EXPECT_LT((dense(newton_euler(I, V, A)) - expected).norm(), 1e-12 * (1 + expected.norm()));
}

TEST_P(SpatialAlgebra, ABodyAtRestNeedsNoVelocity) {
  const RigidBodyInertia<double> I = random.inertia();
  const AccelerationTwist<double> A = random.acceleration();
  expect_near(dense(newton_euler_at_rest(I, A)),
              dense(newton_euler(I, VelocityTwist<double>{}, A)));
}

// Seen from the frame before the joint, and by way of the body's own frame.
TEST_P(SpatialAlgebra, NewtonAndEulerAcrossARevoluteJointAreThoseOfTheBody) {
  const Pose<double> X_AB = revolute_pose(3.0 * random.number());
  const RigidBodyInertia<double> I = random.inertia();
  const VelocityTwist<double> V_A = random.velocity(), V_rel = revolute_velocity(random.number());
  const AccelerationTwist<double> A_A = random.acceleration();
  const AccelerationTwist<double> A_rel = revolute_acceleration(random.number());
  const VelocityTwist<double> V_B = add(transform_to_distal(X_AB, V_A), V_rel);
  const AccelerationTwist<double> A_B = add(transform_to_distal(X_AB, V_A, V_rel, A_A), A_rel);
  const Wrench<double> W_A = newton_euler_across_revolute(X_AB, I, V_A, V_rel, A_A, A_rel);
  expect_near(dense(W_A), dense(transform_to_proximal(X_AB, newton_euler(I, V_B, A_B))));
}

TEST_P(SpatialAlgebra, AcrossARevoluteJointABodyAtRestNeedsNoVelocity) {
  const Pose<double> X_AB = revolute_pose(3.0 * random.number());
  const RigidBodyInertia<double> I = random.inertia();
  const AccelerationTwist<double> A_A = random.acceleration();
  const AccelerationTwist<double> A_rel = revolute_acceleration(random.number());
  expect_near(dense(newton_euler_at_rest_across_revolute(X_AB, I, A_A, A_rel)),
              dense(newton_euler_across_revolute(X_AB, I, VelocityTwist<double>{},
                                                 VelocityTwist<double>{}, A_A, A_rel)));
}

TEST_P(SpatialAlgebra, RotationsKeepTheReferencePoint) {
  const Pose<double> X_AB = random.pose();
  const EigenMatrix3 R = dense(X_AB.R);
  const VelocityTwist<double> V = random.velocity();
  const Wrench<double> W = random.wrench();
  Vector6 proximal, distal;
  proximal << R * dense(V.angular), R * dense(V.linear);
  distal << R.transpose() * dense(V.angular), R.transpose() * dense(V.linear);
  expect_near(dense(rotate_to_proximal(X_AB, V)), proximal);
  expect_near(dense(rotate_to_distal(X_AB, V)), distal);
  expect_near(dense(rotate_to_distal(X_AB, rotate_to_proximal(X_AB, W))), dense(W));
  const AccelerationTwist<double> A = random.acceleration();
  expect_near(dense(rotate_to_proximal(X_AB, rotate_to_distal(X_AB, A))), dense(A));
}

// A pose whose rotation leaves one axis in its place, perhaps reversed.
Pose<double> plane_pose(Random& random, int axis, double sign) {
  const double angle = 3.0 * random.number();
  const double c = std::cos(angle), s = std::sin(angle);
  EigenMatrix3 R = EigenMatrix3::Zero();
  const int b = (axis + 1) % 3, d = (axis + 2) % 3;
  R(axis, axis) = sign;
  R(b, b) = c, R(d, b) = s, R(b, d) = -sign * s, R(d, d) = sign * c;
  return {{R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)},
          random.vector()};
}

std::vector<Pose<double>> poses_of_every_kind(Random& random) {
  std::vector<Pose<double>> poses = {random.pose()};
  for (const int axis : {0, 1, 2}) {
    for (const double sign : {1.0, -1.0}) poses.push_back(plane_pose(random, axis, sign));
  }
  return poses;
}

TEST_P(SpatialAlgebra, MatricesTurnOnBothSidesWhateverTheAxis) {
  const Symmetric3<double> J = random.inertia().rotational;
  const Matrix3<double> H = {random.number(), random.number(), random.number(),
                             random.number(), random.number(), random.number(),
                             random.number(), random.number(), random.number()};
  for (const Pose<double>& X : poses_of_every_kind(random)) {
    const EigenMatrix3 R = dense(X.R);
    expect_near(dense(rotate(X.R, H)), R * dense(H) * R.transpose());
    expect_near(dense(rotate(X.R, J)), R * dense(J) * R.transpose());
  }
}

TEST_P(SpatialAlgebra, InertiasMoveToProximalFramesByCongruence) {
  const RigidBodyInertia<double> I_B = random.inertia();
  for (const Pose<double>& X_AB : poses_of_every_kind(random)) {
    const Matrix6 T = motion_transform(X_AB);
    expect_near(dense(transform_to_proximal(X_AB, I_B)), T.transpose() * dense(I_B) * T);
  }
}

ArticulatedInertia<double> random_articulated(Random& random) {
  const auto symmetric = [&] { return random.inertia().rotational; };
  ArticulatedInertia<double> I = articulated(random.inertia());
  I.H = I.H + Matrix3<double>{random.number(), random.number(), random.number(),
                              random.number(), random.number(), random.number(),
                              random.number(), random.number(), random.number()};
  I.J = I.J + symmetric();
  I.M = I.M + symmetric();
  return I;
}

Matrix6 dense(const ArticulatedInertia<double>& I) {
  Matrix6 result;
  result << dense(I.J), dense(I.H), dense(I.H).transpose(), dense(I.M);
  return result;
}

TEST_P(SpatialAlgebra, ArticulatedInertiasMoveToProximalFramesByCongruence) {
  const ArticulatedInertia<double> I_B = random_articulated(random);
  for (const Pose<double>& X_AB : poses_of_every_kind(random)) {
    const Matrix6 T = motion_transform(X_AB);
    expect_near(dense(transform_to_proximal(X_AB, I_B)), T.transpose() * dense(I_B) * T);
  }
}

TEST_P(SpatialAlgebra, ABodyWithNothingOnItIsArticulatedAsARigidOne) {
  const RigidBodyInertia<double> I = random.inertia();
  expect_near(dense(articulated(I)), dense(I));
}

TEST_P(SpatialAlgebra, UnitWrenchesAreColumnsOfTheInertia) {
  const RigidBodyInertia<double> I = random.inertia();
  const ArticulatedInertia<double> IA = random_articulated(random);
  expect_near(dense(wrench_of_revolute(I)), dense(I).col(2));
  expect_near(dense(wrench_of_prismatic(I)), dense(I).col(5));
  expect_near(dense(wrench_of_revolute(IA)), dense(IA).col(2));
  expect_near(dense(wrench_of_prismatic(IA)), dense(IA).col(5));
}

TEST_P(SpatialAlgebra, AFreeJointTakesItsDirectionOutOfTheInertia) {
  ArticulatedInertia<double> I = random_articulated(random);
  I.J.zz += 5.0;
  I.M.zz += 5.0;
  for (const int column : {2, 5}) {
    const Wrench<double> U = column == 2 ? wrench_of_revolute(I) : wrench_of_prismatic(I);
    const double D = dense(U)(column);
    const Matrix6 expected = dense(I) - dense(U) * dense(U).transpose() / D;
    const ArticulatedInertia<double> projected = project(I, U, D);
    expect_near(dense(projected), expected);
    EXPECT_LT(dense(projected).col(column).norm(), 1e-14);

    const Wrench<double> W = random.wrench();
    const AccelerationTwist<double> A = random.acceleration();
    const double u = random.number();
    expect_near(dense(project(W, U, D, u)), dense(W) + dense(U) * (u / D));
    // With that acceleration of the joint, the force along the joint is u.
    const double qdd = joint_acceleration(u, U, D, A);
    Vector6 total = dense(A);
    total(column) += qdd;
    EXPECT_NEAR((dense(I) * total)(column), u, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(RandomValues, SpatialAlgebra, testing::Range(1U, 31U));

}  // namespace
}  // namespace sinew::math
