// Whose round-off a difference between libraries is: Sinew, MuJoCo and DART beside dense matrices
// in long double, and these beside quadruple precision.
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include "compare.h"
#include "exact_urdf.h"
#include "question.h"
#include "sinew/base/error.h"

namespace sinew::test {
namespace {

using Quad = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                           boost::multiprecision::et_off>;

constexpr unsigned kStates = 1000, kStatesInQuad = 5;
const Eigen::Vector3d kDown(0, 0, -9.81);

template <typename S>
peers::Vector numbers(const Eigen::Matrix<S, Eigen::Dynamic, 1>& from) {
  peers::Vector result;
  for (const S& one : from) result.push_back(static_cast<double>(one));
  return result;
}

template <typename S>
Eigen::Matrix<S, Eigen::Dynamic, 1> exact(const peers::Vector& from) {
  Eigen::Matrix<S, Eigen::Dynamic, 1> result(static_cast<Eigen::Index>(from.size()));
  for (std::size_t i = 0; i < from.size(); ++i) result[static_cast<Eigen::Index>(i)] = S(from[i]);
  return result;
}

template <typename S>
struct Expected {
  peers::Vector force, acceleration;
};

// Forces for the state's accelerations, and accelerations for these forces.
template <typename S>
Expected<S> expected(const ExactRobot<S>& robot, const peers::State& state,
                     const peers::Vector& force) {
  const ExactDynamics<S> dynamics(robot, kDown, exact<S>(state.position), exact<S>(state.velocity));
  return {numbers<S>(dynamics.mass_matrix() * exact<S>(state.acceleration) + dynamics.bias()),
          numbers<S>(dynamics.accelerations(exact<S>(force)))};
}

struct Errors {
  double ours = 0, force = 0, mujoco = 0, dart = 0, reference = 0;
};

void keep(double& error, double now) { error = std::max(error, now); }

Errors errors(const Robot& robot, bool floating, unsigned states) {
  Question rnea(robot, "rnea", floating), aba(robot, "aba", floating);
  const ExactUrdf<long double> longer(robot.urdf, rnea.joints(), floating);
  const ExactUrdf<Quad> quad(robot.urdf, rnea.joints(), floating);
  const peers::Setup setup{robot.urdf, rnea.joints(), floating, {0, 0, -9.81}};
  const auto mujoco = peers::make_mujoco(setup), dart = peers::make_dart(setup);
  Errors worst;
  for (unsigned seed = 0; seed < states; ++seed) {
    const peers::State state = random_state(rnea.joints().size(), seed, floating);
    const peers::Vector force = rnea.answer(state);
    const auto right = expected<long double>(longer.robot(), state, force);
    keep(worst.force, difference(force, right.force));
    keep(worst.ours, difference(aba.answer(state, force), right.acceleration));
    keep(worst.mujoco, difference(mujoco->forward_dynamics(state, force), right.acceleration));
    keep(worst.dart, difference(dart->forward_dynamics(state, force), right.acceleration));
    if (seed < kStatesInQuad)
      keep(worst.reference,
           difference(right.acceleration, expected<Quad>(quad.robot(), state, force).acceleration));
  }
  return worst;
}

bool moves_when_free(const Robot& robot) {
  try {
    Question(robot, "aba", true);
    return true;
  } catch (const Error&) {
    return false;  // agreement_test.cpp says which and why
  }
}

// Each robot's worst error of 1000 states is printed (docs/queries.md).
TEST(Exact, ForwardDynamicsOfPublishedRobotsAreThoseOfLongerNumbers) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots)
    for (const bool floating : {false, true}) {
      if (floating && !moves_when_free(robot)) continue;
      SCOPED_TRACE(robot.name + (floating ? ", floating" : ""));
      const Errors found = errors(robot, floating, kStates);
      std::printf("%-28s %-8s ours %.1e (force %.1e)  MuJoCo %.1e  DART %.1e  reference %.1e\n",
                  robot.name.c_str(), floating ? "floating" : "fixed", found.ours, found.force,
                  found.mujoco, found.dart, found.reference);
      EXPECT_LT(found.reference, 1e-14);
      // Direction cosines within 1e-12 of 0 and ±1 count as that: iiwa.urdf has pi with twelve
      // digits.
      EXPECT_LT(found.force, 1e-11);
      EXPECT_LT(found.ours, 1e-9);
    }
}

}  // namespace
}  // namespace sinew::test
