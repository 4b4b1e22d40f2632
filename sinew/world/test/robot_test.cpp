// Poses, twists and accelerations across a robot's joints, against Orocos KDL; the same query as a
// program; motions over free relations, against differences of poses.
#include "sinew/world/robot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainfksolvervel_recursive.hpp>
#include <random>

#include "random_poses.h"
#include "sinew/backend/interpreter.h"
#include "sinew/graph/store.h"
#include "sinew/model/load.h"
#include "sinew/model/normalise.h"
#include "sinew/world/edit.h"
#include "sinew/world/query_program.h"
#include "sinew/world/world.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

struct Gen3 {
  Gen3() {
    const std::filesystem::path folder = SINEW_SOURCE_DIR "/robots/gen3";
    Report report;
    model::load_files(
        std::vector<std::filesystem::path>{folder / "chain.jsonld", folder / "dynamics.jsonld",
                                           folder / "geometry.jsonld",
                                           folder / "mounting-upright.jsonld"},
        {}, store, places, report);
    report.throw_if_errors();
    tree = model::normalise(store, places, {}, report);
    report.throw_if_errors();
    robot = add_robot(
        world, tree, store.terms(),
        {.provenance = "http://cell/robot-controller", .velocities = true, .accelerations = true});
    tip = world.find_frame(store.terms().text(tree.bodies.back().frame));
  }
  // The chain from the first body to the last, each joint at its placement.
  KDL::Chain kdl() const {
    KDL::Chain chain;
    for (const auto& joint : tree.joints) {
      const auto& X = joint.placement;
      chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None),
                                    KDL::Frame(KDL::Rotation(X.R.xx, X.R.xy, X.R.xz, X.R.yx, X.R.yy,
                                                             X.R.yz, X.R.zx, X.R.zy, X.R.zz),
                                               KDL::Vector(X.p.x, X.p.y, X.p.z))));
      chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ)));
    }
    return chain;
  }
  graph::Store store;
  graph::Places places;
  model::Tree tree;
  World world;
  RobotInWorld robot;
  FrameId tip;
};

double difference_from(const Pose& X, const KDL::Frame& F) {
  const auto M = to_matrix(X);
  const double entries[] = {M.R.xx - F.M(0, 0), M.R.xy - F.M(0, 1), M.R.xz - F.M(0, 2),
                            M.R.yx - F.M(1, 0), M.R.yy - F.M(1, 1), M.R.yz - F.M(1, 2),
                            M.R.zx - F.M(2, 0), M.R.zy - F.M(2, 1), M.R.zz - F.M(2, 2),
                            M.p.x - F.p.x(),    M.p.y - F.p.y(),    M.p.z - F.p.z()};
  double worst = 0;
  for (const double entry : entries) worst = std::max(worst, std::abs(entry));
  return worst;
}

TEST(Robot, ForwardKinematicsInTheGraphIsKdls) {
  Gen3 g;
  ASSERT_EQ(g.robot.positions.size(), 7u);
  std::vector<MeasurementId> all = g.robot.positions;
  all.insert(all.end(), g.robot.velocities.begin(), g.robot.velocities.end());
  all.insert(all.end(), g.robot.accelerations.begin(), g.robot.accelerations.end());
  BatchWriter writer = g.world.claim(all, {"http://cell/robot-controller"});
  PreparedPose pose = g.world.prepare_pose({.of = g.tip, .with_respect_to = g.robot.root});
  PreparedPose back = g.world.prepare_pose({.of = g.robot.root, .with_respect_to = g.tip});
  PreparedMotion motion = g.world.prepare_motion({.of = g.tip, .with_respect_to = g.robot.root});
  EXPECT_EQ(pose.measured_steps(), 7u);
  EXPECT_TRUE(motion.has_acceleration());
  const KDL::Chain chain = g.kdl();
  KDL::ChainFkSolverPos_recursive positions(chain);
  KDL::ChainFkSolverVel_recursive velocities(chain);
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> angle(-3, 3);
  for (int i = 0; i < 200; ++i) {
    double values[21];
    KDL::JntArrayVel q(7);
    for (unsigned k = 0; k < 7; ++k) {
      q.q(k) = values[k] = angle(random);
      q.qdot(k) = values[7 + k] = angle(random);
      values[14 + k] = 0;
    }
    ASSERT_EQ(writer.write(at_s(i + 1), values), Status::kOk);
    KDL::Frame F;
    positions.JntToCart(q.q, F);
    EXPECT_LT(difference_from(pose.latest(at_s(i + 1)).pose, F), 1e-14);
    EXPECT_LT(difference_from(back.latest(at_s(i + 1)).pose, F.Inverse()), 1e-14);
    KDL::FrameVel V;
    velocities.JntToCart(q, V);
    const KDL::Vector v = V.M.R.Inverse() * V.p.v, w = V.M.R.Inverse() * V.M.w;
    const MotionAnswer moving = motion.latest(at_s(i + 1));
    ASSERT_EQ(moving.status, Status::kOk);
    EXPECT_NEAR(moving.twist.linear.x, v.x(), 1e-13);
    EXPECT_NEAR(moving.twist.linear.y, v.y(), 1e-13);
    EXPECT_NEAR(moving.twist.linear.z, v.z(), 1e-13);
    EXPECT_NEAR(moving.twist.angular.x, w.x(), 1e-13);
    EXPECT_NEAR(moving.twist.angular.z, w.z(), 1e-13);
  }
}

TEST(Robot, JointPositionsAreInterpolatedInTime) {
  Gen3 g;
  for (const double t : {0.0, 1.0}) {
    for (const MeasurementId m : g.robot.positions) {
      g.world.write(m, at_s(t), std::vector<double>{t}, {"http://cell/robot-controller"});
    }
  }
  PreparedPose pose = g.world.prepare_pose({.of = g.tip, .with_respect_to = g.robot.root});
  const Pose between = pose.at(at_s(0.25)).pose;
  for (const MeasurementId m : g.robot.positions) {
    g.world.write(m, at_s(2), std::vector<double>{0.25}, {"http://cell/robot-controller"});
  }
  EXPECT_LT(difference(pose.latest(at_s(2)).pose, between), 1e-14);
}

TEST(Robot, TheSameQueryAsAProgram) {
  Gen3 g;
  const FrameId part = g.world.add_frame("http://cell/part");
  const RelationId seen = g.world.add_relation(
      {.name = "http://cell/part-from-tip", .of = g.tip, .with_respect_to = part});
  const MeasurementId measured =
      g.world.add_measurement({.name = "http://cell/seen", .relation = seen});
  const PoseQuery query{.of = part, .with_respect_to = g.robot.root};
  std::mt19937_64 random(22);
  for (int i = 0; i < 7; ++i) {
    g.world.write(g.robot.positions[static_cast<std::size_t>(i)], at_s(1),
                  std::vector<double>{0.3 * i - 1}, {});
  }
  g.world.write(measured, at_s(1), random_pose(random), {});
  graph::Store store;
  const PoseProgram program = make_pose_program(g.world, query, store, "part");
  EXPECT_EQ(program.inputs.size(), 8u);
  backend::Interpreter interpreter(program.program);
  ASSERT_EQ(interpreter.out_size(), 12u);
  for (int i = 0; i < 50; ++i) {
    std::vector<double> in(program.in_size), out(12);
    ASSERT_EQ(program.gather(g.world, at_s(100), in), Status::kOk);
    interpreter.evaluate(in.data(), out.data());
    const auto X = to_matrix(g.world.prepare_pose(query).latest(at_s(100)).pose);
    const double expected[12] = {X.R.xx, X.R.xy, X.R.xz, X.p.x,  X.R.yx, X.R.yy,
                                 X.R.yz, X.p.y,  X.R.zx, X.R.zy, X.R.zz, X.p.z};
    for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(out[k], expected[k], 1e-13) << k;
    g.world.write(measured, at_s(2 + i), random_pose(random), {});
    g.world.write(g.robot.positions[3], at_s(2 + i), std::vector<double>{0.1 * i}, {});
  }
  // The same way again gives the same algorithm.
  EXPECT_EQ(make_pose_program(g.world, query, store, "part").algorithm, program.algorithm);
  EXPECT_THROW(make_pose_program(
                   g.world, {.of = g.world.add_frame("http://cell/far"), .with_respect_to = part},
                   store, "far"),
               Error);
}

// Three relations that move as their declared twists and accelerations say, one of them walked from
// B to A: the twist and acceleration of the ends are what differences of the poses say.
TEST(Motion, OverFreeRelationsIsTheDerivativeOfThePose) {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> small(-1, 1);
  for (int run = 0; run < 40; ++run) {
    struct Link {
      Pose X;
      Twist V;
      Twist rate;  // derivative of the six numbers of V
      Pose at(double t) const {
        // exp(V t + rate t^2 / 2) agrees with the motion up to the third order in t.
        return compose(X, exponential({t * V.angular + 0.5 * t * t * rate.angular,
                                       t * V.linear + 0.5 * t * t * rate.linear},
                                      1));
      }
    };
    const auto vector = [&] { return Vector3{small(random), small(random), small(random)}; };
    Link links[3];
    for (Link& link : links) {
      link = {random_pose(random), {vector(), vector()}, {vector(), vector()}};
    }
    World world;
    std::vector<FrameId> f;
    for (int i = 0; i < 4; ++i) f.push_back(world.add_frame("http://x/f" + std::to_string(i)));
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const std::string name = "http://x/r" + std::to_string(i);
      const bool turned = i == 1;  // the way leads from its B to its A
      const RelationId r = world.add_relation({.name = name,
                                               .of = turned ? f[k] : f[k + 1],
                                               .with_respect_to = turned ? f[k + 1] : f[k]});
      const auto add = [&](const char* what, Quantity quantity, std::vector<double> values) {
        const MeasurementId m =
            world.add_measurement({.name = name + what, .relation = r, .quantity = quantity});
        ASSERT_EQ(world.write(m, at_s(0), values, {}), Status::kOk);
      };
      const Link& l = links[i];
      add("/pose", Quantity::kPose,
          {l.X.q.x, l.X.q.y, l.X.q.z, l.X.q.w, l.X.p.x, l.X.p.y, l.X.p.z});
      add("/twist", Quantity::kTwist,
          {l.V.angular.x, l.V.angular.y, l.V.angular.z, l.V.linear.x, l.V.linear.y, l.V.linear.z});
      const Vector3 a = l.rate.linear + math::cross(l.V.angular, l.V.linear);  // classical
      add("/acceleration", Quantity::kAcceleration,
          {l.rate.angular.x, l.rate.angular.y, l.rate.angular.z, a.x, a.y, a.z});
    }
    const MotionAnswer answer =
        world.prepare_motion({.of = f[3], .with_respect_to = f[0]}).latest(at_s(0));
    ASSERT_EQ(answer.status, Status::kOk);
    const auto at = [&](double t) {
      return compose(compose(links[0].at(t), invert(links[1].at(t))), links[2].at(t));
    };
    constexpr double h = 1e-4;
    const auto R = to_matrix(at(0)).R;
    const auto from_centre = [&](double t) { return logarithm(compose(invert(at(0)), at(t))); };
    const Vector3 w = (1 / (2 * h)) * (from_centre(h).angular - from_centre(-h).angular);
    const Vector3 v = (1 / (2 * h)) * math::transpose_times(R, at(h).p - at(-h).p);
    const Vector3 a =
        (1 / (h * h)) * math::transpose_times(R, (at(h).p - at(0).p) - (at(0).p - at(-h).p));
    // The logarithm's second derivative is the derivative of the body's angular velocity.
    const Vector3 al = (1 / (h * h)) * (from_centre(h).angular + from_centre(-h).angular);
    const auto near = [](const Vector3& x, const Vector3& y, double tolerance) {
      EXPECT_NEAR(x.x, y.x, tolerance);
      EXPECT_NEAR(x.y, y.y, tolerance);
      EXPECT_NEAR(x.z, y.z, tolerance);
    };
    near(answer.twist.angular, w, 1e-6);
    near(answer.twist.linear, v, 1e-6);
    near(answer.acceleration.angular, al, 1e-4);
    near(answer.acceleration.linear, a, 1e-4);
  }
}

TEST(Motion, IsRefusedWhereARelationHasNone) {
  Gen3 g;
  World world;
  const RobotInWorld still = add_robot(world, g.tree, g.store.terms(), {.provenance = "x"});
  for (const MeasurementId m : still.positions) {
    world.write(m, at_s(0), std::vector<double>{0.0}, {});
  }
  const FrameId tip = world.find_frame(g.store.terms().text(g.tree.bodies.back().frame));
  PreparedMotion motion = world.prepare_motion({.of = tip, .with_respect_to = still.root});
  EXPECT_FALSE(motion.has_twist());
  EXPECT_EQ(motion.latest(at_s(0)).status, Status::kNoMotion);
}

}  // namespace
}  // namespace sinew::world
