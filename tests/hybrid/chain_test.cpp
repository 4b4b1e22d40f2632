// On serial chains, beside KDL's solver of the same problem.
#include <gtest/gtest.h>

#include <kdl/chain.hpp>
#include <kdl/chainfksolvervel_recursive.hpp>
#include <kdl/chainhdsolver_vereshchagin.hpp>
#include <random>

#include "hybrid_question.h"
#include "kdl_model.h"
#include "random_urdf.h"

namespace sinew::test {
namespace {

// KDL's solver divides by zero at fixed joints, so the robots here have none behind the first
// moving one. What is fixed to the base before it becomes part of the first joint's origin.
KDL::Chain chain_of(const urdf::ModelInterface& model, std::string& tip) {
  KDL::Chain chain;
  urdf::LinkConstSharedPtr link = model.getRoot();
  KDL::Frame before = KDL::Frame::Identity();
  while (link->child_joints.size() == 1) {
    const auto& j = *link->child_joints.front();
    link = link->child_links.front();
    const KDL::Frame origin = before * peers::kdl_frame(j.parent_to_joint_origin_transform);
    if (!peers::moves(j)) {
      if (chain.getNrOfJoints() > 0) throw std::runtime_error(j.name + " is fixed");
      before = origin;
      continue;
    }
    before = KDL::Frame::Identity();
    const auto type =
        j.type == urdf::Joint::PRISMATIC ? KDL::Joint::TransAxis : KDL::Joint::RotAxis;
    const KDL::Vector axis = origin.M * KDL::Vector(j.axis.x, j.axis.y, j.axis.z);
    chain.addSegment(KDL::Segment(link->name, KDL::Joint(j.name, origin.p, axis, type), origin,
                                  peers::kdl_inertia(*link)));
  }
  tip = link->name;
  return chain;
}

struct Largest {
  double acceleration = 0, magnitude = 0, met = 0;
};

KDL::JntArray array(const peers::Vector& numbers) {
  KDL::JntArray result(static_cast<unsigned>(numbers.size()));
  for (unsigned i = 0; i < result.rows(); ++i) result(i) = numbers[i];
  return result;
}

double relative(const VectorXd& a, const VectorXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / std::max(1.0, b.lpNorm<Eigen::Infinity>());
}

// Six numbers, moment first, as KDL has them.
KDL::Wrench kdl_wrench(const double* w) {
  return {KDL::Vector(w[3], w[4], w[5]), KDL::Vector(w[0], w[1], w[2])};
}

void compare(const Robot& robot, const std::vector<int>& axes, unsigned states, Largest& largest) {
  const auto model = peers::parse_urdf(robot.urdf);
  std::string tip;
  const KDL::Chain chain = chain_of(*model, tip);
  const unsigned n = chain.getNrOfJoints(), m = static_cast<unsigned>(axes.size());
  Problem problem;
  for (const int i : axes) problem.constraints.push_back({tip, axis(i), false, 0});
  cli::QueryOptions options;
  options.solver = "hybrid";
  options.gravity = "0,0,-9.81";
  options.constraints = constraint_options(problem.constraints);
  options.give = {"external-wrench of " + tip};
  Question question(robot, options);
  ASSERT_EQ(question.joints().size(), n);

  std::mt19937 random(5);
  std::uniform_real_distribution<> number(-1, 1);
  KDL::ChainHdSolver_Vereshchagin solver(
      chain, KDL::Twist(KDL::Vector(0, 0, 9.81), KDL::Vector::Zero()), m);
  KDL::ChainFkSolverVel_recursive forward(chain);
  const peers::Setup setup{robot.urdf, question.joints(), false, {0, 0, -9.81}};
  const auto peer = peers::make_kdl(setup);
  unsigned compared = 0;
  for (unsigned seed = 0; seed < states; ++seed) {
    problem.state = random_state(n, seed);
    problem.force.resize(n);
    for (double& force : problem.force) force = 10 * number(random);
    for (DenseConstraint& one : problem.constraints) one.energy = 3 * number(random);
    peers::Vector wrench(6);
    for (double& one : wrench) one = 5 * number(random);
    problem.wrenches = {{tip, wrench}};
    // Where the chain is nearly singular, both are round-off.
    const DenseSolution dense = solve_densely(*peer, problem);
    if (dense.condition > 1e4) continue;
    ++compared;

    // KDL imposes the spatial acceleration, gravity's included, and takes wrenches seen from the
    // base; ours is the acceleration of the tip's origin with respect to the base.
    const KDL::JntArray q = array(problem.state.position), qd = array(problem.state.velocity);
    KDL::FrameVel motion;
    ASSERT_GE(forward.JntToCart(KDL::JntArrayVel(q, qd), motion), 0);
    const KDL::Vector extra =
        KDL::Vector(0, 0, 9.81) - motion.M.w * motion.p.v;  // * is the cross product
    KDL::Jacobian alpha(m);
    KDL::JntArray beta(m);
    for (unsigned i = 0; i < m; ++i) {
      const DenseConstraint& one = problem.constraints[i];
      const KDL::Wrench force = kdl_wrench(one.direction.data());
      alpha.setColumn(i, KDL::Twist(force.force, force.torque));
      beta(i) = one.energy + KDL::dot(force.force, extra);
    }
    KDL::Wrenches external(chain.getNrOfSegments(), KDL::Wrench::Zero());
    external.back() = motion.M.R * kdl_wrench(wrench.data());
    KDL::JntArray qdd(n), constraint_force(n);
    ASSERT_EQ(
        solver.CartToJnt(q, qd, qdd, alpha, beta, external, array(problem.force), constraint_force),
        0);
    Eigen::VectorXd nu(m);
    solver.getContraintForceMagnitude(nu);

    const auto ours = answers(question, problem);
    const VectorXd acceleration = outputs(question, ours, "acceleration");
    const VectorXd magnitude = outputs(question, ours, "constraint-magnitude");
    largest.acceleration = std::max(largest.acceleration, relative(acceleration, qdd.data));
    // KDL's multipliers are those of the reaction.
    largest.magnitude = std::max(largest.magnitude, relative(magnitude, -nu));
    const VectorXd met = dense.jacobian * acceleration + dense.bias;
    for (unsigned i = 0; i < m; ++i)
      largest.met = std::max(largest.met, std::fabs(met(i) - problem.constraints[i].energy));
    EXPECT_LT(relative(outputs(question, ours, "constraint-force"), dense.constraint_force), 1e-8);
  }
  EXPECT_GT(compared, states / 2);
}

void expect_agreement(const Largest& largest) {
  EXPECT_LT(largest.acceleration, 1e-8);
  EXPECT_LT(largest.magnitude, 1e-8);
  EXPECT_LT(largest.met, 1e-8);
}

const std::vector<std::vector<int>> kSubsets = {{3},       {5, 0},       {3, 4, 5},
                                                {0, 1, 2}, {2, 3, 4, 5}, {0, 1, 2, 3, 4, 5}};

TEST(HybridOnChains, AgreesWithKdlForEverySubsetOfDirections) {
  const std::filesystem::path folder = SINEW_SHARED_DIR "/robots";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "there are no robots in " << folder;
  for (const Robot& robot : published_robots()) {
    if (robot.name != "iiwa.urdf" && robot.name != "clean/iiwa.urdf" &&
        robot.name != "clean/gen3.urdf" && robot.name != "clean/general_7r.urdf")
      continue;
    for (const std::vector<int>& axes : kSubsets) {
      SCOPED_TRACE(robot.name + ", directions: " + std::to_string(axes.size()));
      Largest largest;
      compare(robot, axes, 100, largest);
      expect_agreement(largest);
    }
  }
}

TEST(HybridOnChains, AgreesWithKdlOnRandomChains) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    RandomRobot random;
    random.joints = 6 + 3 * seed;
    random.branching = random.fixed = 0;
    random.seed = seed;
    const TemporaryRobot robot(random_urdf(random));
    SCOPED_TRACE(seed);
    Largest largest;
    compare(robot.robot(), kSubsets[seed % kSubsets.size()], 50, largest);
    expect_agreement(largest);
  }
}

}  // namespace
}  // namespace sinew::test
