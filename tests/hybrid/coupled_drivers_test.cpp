// Where joints follow others: drivers kept apart, weighed, and scaled down to what actuators can
// do.
#include <gtest/gtest.h>

#include "coupled_reference.h"
#include "sinew/program/interface.h"

namespace sinew::test::coupled {
namespace {

TEST(CoupledHybrid, DriversApartSumToWhatTheyDoTogether) {
  const TestRobot robot = coupled_tree(8);
  std::mt19937 random(8);
  Task task = random_task(robot, random, 2);
  cli::QueryOptions query = query_of(task);
  ModelSolver together(turtle(robot), query);
  query.drivers = "apart";
  ModelSolver apart(turtle(robot), query);
  for (unsigned seed = 0; seed < 5; ++seed) {
    draw(robot, random, seed, task);
    set(together, task);
    set(apart, task);
    const auto expected = together.answer(robot, task.state, task.force),
               found = apart.answer(robot, task.state, task.force);
    const VectorXd acceleration = joined(robot, expected, "acceleration");
    EXPECT_LT(difference(joined(robot, found, "acceleration"), acceleration), 1e-9);
    std::map<std::string, double> sums;
    std::size_t drivers = 0;
    for (const auto& [name, effect] : found) {
      if (!name.starts_with("driver-acceleration.")) continue;
      sums[name.substr(name.rfind('.') + 1)] += effect[0];
      ++drivers;
    }
    ASSERT_EQ(sums.size(), static_cast<std::size_t>(robot.velocities));
    EXPECT_GT(drivers, 4 * sums.size());
    VectorXd sum(robot.velocities), total(robot.velocities);
    Eigen::Index at = 0;
    for (const auto& [joint, number] : sums) {
      sum[at] = number;
      // A helical joint's driving part is called after it.
      const std::string of = joint.substr(0, joint.find('-'));
      total[at++] = expected.at("acceleration." + of)[0];
    }
    EXPECT_LT(difference(sum, total), 1e-9);
  }
}

// The numbers of a task as an input for each driver makes them: how many times each counts.
Task weighed_by(const TestRobot& robot, const std::map<std::string, double>& weights, Task task) {
  task.gravity = weights.at("gravity");
  task.velocity = weights.at("velocity");
  for (Wrench& one : task.wrenches) one.numbers *= weights.at("wrench-" + frame(one.link));
  for (Imposed& one : task.imposed) one.energy *= weights.at("constraint-" + frame(one.link));
  for (const TestJoint& joint : robot.joints)
    if (joint.leader < 0) task.force[joint.velocity] *= weights.at("force-" + joint.name);
  return task;
}

TEST(CoupledHybrid, WeighedDriversAreThoseOfTheDenseSolutionWithSoMuchOfEach) {
  unsigned compared = 0;
  for (const unsigned joints : {4u, 7u, 10u, 14u}) {
    SCOPED_TRACE(joints);
    const TestRobot robot = coupled_tree(joints);
    std::mt19937 random(joints);
    Task task = random_task(robot, random, 2);
    cli::QueryOptions query = query_of(task);
    query.drivers = "weighed";
    ModelSolver weighed(turtle(robot), query);
    std::uniform_real_distribution<> weight(-1.5, 2);
    for (unsigned seed = 0; seed < 6; ++seed) {
      draw(robot, random, 100 * joints + seed, task);
      set(weighed, task);
      std::map<std::string, double> weights;
      for (const auto& slot : program::interface_of(weighed.program()).inputs) {
        const std::string& input = weighed.program().variables[slot.variable].name;
        if (!input.starts_with("driver-weight.")) continue;
        // The first round has all of each, the second none of velocity and gravity.
        const bool off = seed == 1 && (input.ends_with(".gravity") || input.ends_with(".velocity"));
        const double number = seed == 0 ? 1 : off ? 0 : weight(random);
        weighed.set(input, VectorXd::Constant(1, number));
        // A helical joint's driving part is called after it.
        const std::string driver = input.substr(input.find('.') + 1);
        const bool of_joint = driver.starts_with("force-");
        weights[of_joint ? driver.substr(0, driver.find('-', 6)) : driver] = number;
      }
      const Solution expected = solve(robot, weighed_by(robot, weights, task));
      if (!(expected.condition < 1e4)) continue;
      ++compared;
      const auto found = weighed.answer(robot, task.state, task.force);
      EXPECT_LT(difference(joined(robot, found, "acceleration"), expected.acceleration), 1e-8);
      EXPECT_LT(difference(magnitudes(task, found), expected.magnitude), 1e-8);
      EXPECT_LT(difference(joined(robot, found, "constraint-force"), expected.constraint_force),
                1e-8);
    }
  }
  EXPECT_GT(compared, 12u);
}

// An actuator drives the joint at the head of a line and through it all that follow: its limit is
// that of the head, and what counts against it is the sum.
TEST(CoupledHybrid, OneDriverIsScaledDownUntilNoActuatorSaturates) {
  const TestRobot robot = finger();
  std::string model = turtle(robot);
  for (const auto& [joint, limit] : {std::pair<std::string, double>{"j0", 1.5}, {"j1", 1e-6}})
    model += ":" + joint + "-limit a skc:JointForceLimit ; kc-stat:of-joint :" + joint +
             " ; skc:maximum " + std::to_string(limit) + " ; qudt:unit unit:N-M .\n";
  Task task;
  task.imposed.push_back({3, 4, true, 0});
  cli::QueryOptions query = query_of(task);
  ModelSolver together(model, query);
  query.limited = frame(3);
  ModelSolver limited(model, query);
  unsigned scaled = 0, untouched = 0;
  std::mt19937 random(4);
  for (unsigned seed = 0; seed < 60; ++seed) {
    draw(robot, random, seed, task);
    task.force *= 0.1;
    task.imposed.front().energy *= 3;
    set(limited, task);
    const auto found = limited.answer(robot, task.state, task.force);
    const double scale = found.at("driver-scale.constraint-" + frame(3))[0];
    ASSERT_GE(scale, 0);
    ASSERT_LE(scale, 1);
    Task smaller = task;
    smaller.imposed.front().energy *= scale;
    set(together, smaller);
    const auto expected = together.answer(robot, task.state, task.force);
    EXPECT_LT(difference(found.at("acceleration.j0"), expected.at("acceleration.j0")), 1e-9);
    const double control = std::abs(found.at("control-force.j0")[0]);
    if (scale > 0) {
      EXPECT_LE(control, 1.5 + 1e-9);
    }
    scaled += scale > 0 && scale < 1 ? 1 : 0;
    untouched += scale == 1 ? 1 : 0;
    if (scale > 0 && scale < 1) {
      EXPECT_NEAR(control, 1.5, 1e-9);
    }
  }
  EXPECT_GT(scaled, 5u);
  EXPECT_GT(untouched, 5u);
}

}  // namespace
}  // namespace sinew::test::coupled
