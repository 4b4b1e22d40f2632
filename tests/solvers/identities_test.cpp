// What must hold between the answers to several questions of one robot, whatever it is.
#include <gtest/gtest.h>

#include "compare.h"
#include "question.h"

namespace sinew::test {
namespace {

using peers::Vector;

cli::QueryOptions options(const std::string& solvers, bool floating = false) {
  cli::QueryOptions query;
  query.solver = solvers;
  query.gravity = "0,0,-9.81";
  query.floating = floating;
  return query;
}

Vector times(const Vector& matrix, const Vector& vector) {
  const std::size_t n = vector.size();
  Vector result(matrix.size() / n, 0.0);
  for (std::size_t i = 0; i < matrix.size(); ++i) result[i / n] += matrix[i] * vector[i % n];
  return result;
}

Vector plus(const Vector& a, const Vector& b, double factor = 1) {
  Vector sum(a);
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] += factor * b[i];
  return sum;
}

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// The numbers of one quantity of all joints, in their order; a floating base's first.
Vector of_joints(const Question& question, const std::map<std::string, Vector>& answers,
                 const std::string& quantity) {
  Vector all;
  for (const program::Variable& variable : question.program().variables) {
    if (!variable.output || !variable.name.starts_with(quantity + ".")) continue;
    const Vector& numbers = answers.at(variable.name);
    all.insert(all.end(), numbers.begin(), numbers.end());
  }
  return all;
}

TEST(Identity, MassTimesAccelerationAndBiasIsForce) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    for (const bool floating : {false, true}) {
      SCOPED_TRACE(robot.name + (floating ? ", floating" : ""));
      Question question(robot, options("rnea,crba,bias", floating));
      for (unsigned seed = 0; seed < 200; ++seed) {
        const peers::State state = random_state(question.joints().size(), seed, floating);
        const auto now = question.answers(state);
        const Vector force = of_joints(question, now, "force"),
                     bias = of_joints(question, now, "bias-force");
        EXPECT_LT(difference(plus(times(now.at("mass-matrix"), state.acceleration), bias), force),
                  1e-8);
      }
    }
  }
}

// In one program the planner computes some answers from others (synthesis/steps_together.h); apart,
// it cannot. Gravity along an axis of the base, and along none; with a wrench from outside.
TEST(Identity, WhatIsAskedTogetherIsWhatIsAskedApart) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  const char* const solvers[] = {"fpk", "fvk", "jacobian", "rnea", "bias", "gravity", "crba"};
  for (const Robot& robot : robots) {
    for (const bool floating : {false, true}) {
      for (const char* gravity : {"0,0,-9.81", "0.5,-3,-9"}) {
        SCOPED_TRACE(robot.name + (floating ? ", floating, " : ", ") + gravity);
        cli::QueryOptions query = options("fpk,fvk,jacobian,rnea,bias,gravity,crba", floating);
        query.gravity = gravity;
        Question together(robot, query);
        std::string link;
        for (const program::Variable& variable : together.program().variables)
          if (variable.output && variable.name.starts_with("pose.")) link = variable.name.substr(5);
        query.give = {"external-wrench of " + link};
        Question pushed(robot, query);
        for (const char* solver : solvers) {
          for (Question* all : {&together, &pushed}) {
            query.solver = solver;
            query.give.clear();
            if (all == &pushed) query.give = {"external-wrench of " + link};
            Question one(robot, query);
            for (unsigned seed = 0; seed < 10; ++seed) {
              const peers::State state = random_state(together.joints().size(), seed, floating);
              const Vector push = {0.3, -0.2, 0.5, -0.4, 0.7, -0.9};
              all->set("wrench." + link, push);
              one.set("wrench." + link, push);
              const auto found = all->answers(state);
              for (const auto& [name, numbers] : one.answers(state))
                EXPECT_LT(difference(found.at(name), numbers), 1e-10) << name;
            }
          }
        }
      }
    }
  }
}

TEST(Identity, MatrixTimesVelocityIsMomentumAndTheCentersVelocity) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    for (const bool floating : {false, true}) {
      SCOPED_TRACE(robot.name + (floating ? ", floating" : ""));
      Question question(robot, options("momentum,com,energy,crba", floating));
      for (unsigned seed = 0; seed < 200; ++seed) {
        const peers::State state = random_state(question.joints().size(), seed, floating);
        const auto now = question.answers(state);
        EXPECT_LT(difference(times(now.at("centroidal-momentum-matrix"), state.velocity),
                             now.at("centroidal-momentum")),
                  1e-10);
        EXPECT_LT(difference(times(now.at("center-of-mass-jacobian"), state.velocity),
                             now.at("center-of-mass-velocity")),
                  1e-10);
        EXPECT_LT(
            difference({0.5 * dot(state.velocity, times(now.at("mass-matrix"), state.velocity))},
                       now.at("kinetic-energy")),
            1e-10);
      }
    }
  }
}

// The state after a step of the classical method of Runge and Kutta, under constant joint forces.
peers::State later(Question& aba, const peers::State& state, const Vector& force, double step) {
  const auto derivative = [&](const peers::State& at) {
    peers::State d;
    d.position = at.velocity;
    d.velocity = aba.answer(at, force);
    return d;
  };
  const auto moved = [](const peers::State& at, const peers::State& d, double time) {
    peers::State next = at;
    next.position = plus(at.position, d.position, time);
    next.velocity = plus(at.velocity, d.velocity, time);
    return next;
  };
  const peers::State a = derivative(state), b = derivative(moved(state, a, step / 2)),
                     c = derivative(moved(state, b, step / 2)),
                     d = derivative(moved(state, c, step));
  peers::State next = moved(state, a, step / 6);
  next = moved(next, b, step / 3);
  next = moved(next, c, step / 3);
  return moved(next, d, step / 6);
}

// Along a second of falling and being driven, energy grows by the work that the drives do.
TEST(Identity, EnergyGrowsByTheWorkOfTheJointForces) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    if (robot.name.find("baxter") != std::string::npos) continue;  // fingers of grams: too stiff
    SCOPED_TRACE(robot.name);
    Question aba(robot, "aba"), energy(robot, options("energy"));
    peers::State state = random_state(aba.joints().size(), 3);
    state.velocity.assign(state.velocity.size(), 0);
    const Vector force(state.velocity.size(), 0.1);
    const auto total = [&] {
      const auto now = energy.answers(state);
      return now.at("kinetic-energy")[0] + now.at("potential-energy")[0];
    };
    const double before = total();
    const Vector start = state.position;
    constexpr int kSteps = 20'000;
    double largest_kinetic = 0;
    for (int step = 0; step < kSteps; ++step) {
      state = later(aba, state, force, 1.0 / kSteps);
      if (step % 1000 == 0)
        largest_kinetic = std::max(largest_kinetic, energy.answers(state).at("kinetic-energy")[0]);
    }
    const double work = dot(force, plus(state.position, start, -1));
    EXPECT_NEAR(total() - before, work, 1e-4 * std::max(1.0, largest_kinetic));
    EXPECT_GT(largest_kinetic, 1e-3);  // it did move
  }
}

}  // namespace
}  // namespace sinew::test
