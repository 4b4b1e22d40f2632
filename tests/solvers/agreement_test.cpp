// Sinew's answers beside those of libraries that no one here wrote, for published robots and for
// trees that nobody drew.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>

#include "compare.h"
#include "humanoid_urdf.h"
#include "question.h"
#include "random_urdf.h"
#include "sinew/base/error.h"
#include "temporary_urdf.h"

namespace sinew::test {
namespace {

constexpr unsigned kStates = 1000;

std::vector<std::unique_ptr<peers::Peer>> all_peers(const Robot& robot,
                                                    const std::vector<std::string>& joints) {
  const peers::Setup setup{robot.urdf, joints, false, {0, 0, -9.81}};
  std::vector<std::unique_ptr<peers::Peer>> result;
  result.push_back(peers::make_kdl(setup));
  result.push_back(peers::make_mujoco(setup));
  result.push_back(peers::make_dart(setup));
  return result;
}

// The link whose frame a result pose.LINK is.
std::vector<std::string> pose_links(const program::Program& program) {
  std::vector<std::string> links;
  for (const program::Variable& variable : program.variables) {
    if (variable.output) links.push_back(variable.name.substr(variable.name.find('.') + 1));
  }
  return links;
}

struct Errors {
  double pose = 0, force = 0, mass_matrix = 0, acceleration = 0, round_trip = 0;
};

Errors compare(const Robot& robot, unsigned states) {
  Question fpk(robot, "fpk"), rnea(robot, "rnea"), crba(robot, "crba"), aba(robot, "aba");
  const auto others = all_peers(robot, rnea.joints());
  const auto links = pose_links(fpk.program());
  Errors errors;
  for (unsigned seed = 0; seed < states; ++seed) {
    const peers::State state = random_state(rnea.joints().size(), seed);
    const peers::Vector poses = fpk.answer(state), force = rnea.answer(state),
                        mass = crba.answer(state), acceleration = aba.answer(state, force);
    errors.round_trip = std::max(errors.round_trip, difference(acceleration, state.acceleration));
    for (const auto& other : others) {
      errors.force = std::max(errors.force, difference(force, other->inverse_dynamics(state)));
      errors.mass_matrix =
          std::max(errors.mass_matrix, difference(mass, other->mass_matrix(state)));
      if (other->name() != "KDL") {
        errors.acceleration = std::max(
            errors.acceleration, difference(acceleration, other->forward_dynamics(state, force)));
      }
      for (std::size_t i = 0; i < links.size(); ++i) {
        const peers::Vector pose(poses.begin() + static_cast<std::ptrdiff_t>(12 * i),
                                 poses.begin() + static_cast<std::ptrdiff_t>(12 * i + 12));
        errors.pose = std::max(errors.pose, difference(pose, other->link_pose(state, links[i])));
      }
    }
  }
  return errors;
}

TEST(Agreement, OfPublishedRobotsWithKdlMujocoAndDart) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    SCOPED_TRACE(robot.name);
    const Errors errors = compare(robot, kStates);
    EXPECT_LT(errors.pose, 1e-10);
    EXPECT_LT(errors.force, 1e-9);
    EXPECT_LT(errors.mass_matrix, 1e-8);
    EXPECT_LT(errors.acceleration, 1e-8);
    EXPECT_LT(errors.round_trip, 1e-8);
  }
}

TEST(Agreement, OfRandomTreesWithKdlMujocoAndDart) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("sinew-random-" + std::to_string(::getpid()) + ".urdf");
  unsigned seed = 1;
  for (const unsigned joints : {2u, 3u, 5u, 8u, 13u, 21u, 34u, 60u}) {
    for (const double branching : {0.0, 0.5}) {
      RandomRobot random;
      random.joints = joints;
      random.branching = branching;
      random.seed = seed++;
      const Robot robot{"random", file.string(), random_urdf(random)};
      std::ofstream(file) << robot.urdf;
      SCOPED_TRACE(testing::Message() << joints << " joints, seed " << random.seed);
      const Errors errors = compare(robot, 20);
      EXPECT_LT(errors.pose, 1e-10);
      EXPECT_LT(errors.force, 1e-9);
      EXPECT_LT(errors.mass_matrix, 1e-8);
      EXPECT_LT(errors.acceleration, 1e-8);
    }
  }
  std::filesystem::remove(file);
}

// A floating base without mass that one joint holds may turn about that joint's axis as fast as it
// likes: forces do not say how. Inverse dynamics and the mass matrix are there all the same.
bool moves_when_free(const Robot& robot) {
  try {
    Question(robot, "aba", true);
    return true;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("it floats, has no mass"), std::string::npos)
        << error.what();
    return false;
  }
}

void expect_agreement_of_floating(const Robot& robot, unsigned states) {
  SCOPED_TRACE(robot.name);
  Question fpk(robot, "fpk", true), rnea(robot, "rnea", true), crba(robot, "crba", true);
  std::optional<Question> aba;
  if (moves_when_free(robot)) aba.emplace(robot, "aba", true);
  const auto links = pose_links(fpk.program());
  const peers::Setup setup{robot.urdf, rnea.joints(), true, {0, 0, -9.81}};
  const auto mujoco = peers::make_mujoco(setup), dart = peers::make_dart(setup);
  Errors errors;
  for (unsigned seed = 0; seed < states; ++seed) {
    const peers::State state = random_state(rnea.joints().size(), seed, true);
    const peers::Vector poses = fpk.answer(state), force = rnea.answer(state),
                        mass = crba.answer(state);
    const peers::Vector acceleration = aba ? aba->answer(state, force) : state.acceleration;
    const auto keep = [](double& error, double now) { error = std::max(error, now); };
    keep(errors.round_trip, difference(acceleration, state.acceleration));
    for (const auto& other : {mujoco.get(), dart.get()}) {
      keep(errors.force, difference(force, other->inverse_dynamics(state)));
      keep(errors.mass_matrix, difference(mass, other->mass_matrix(state)));
      if (aba)
        keep(errors.acceleration, difference(acceleration, other->forward_dynamics(state, force)));
      for (std::size_t i = 0; i < links.size(); ++i) {
        const peers::Vector pose(poses.begin() + static_cast<std::ptrdiff_t>(12 * i),
                                 poses.begin() + static_cast<std::ptrdiff_t>(12 * i + 12));
        keep(errors.pose, difference(pose, other->link_pose(state, links[i])));
      }
    }
  }
  EXPECT_LT(errors.pose, 1e-10);
  EXPECT_LT(errors.force, 1e-8);
  EXPECT_LT(errors.mass_matrix, 1e-8);
  EXPECT_LT(errors.acceleration, 1e-8);
  EXPECT_LT(errors.round_trip, 1e-8);
}

TEST(Agreement, OfFloatingRobotsWithMujocoAndDart) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) expect_agreement_of_floating(robot, kStates);
}

TEST(Agreement, OfHumanoidsWithMujocoAndDart) {
  for (const std::uint32_t seed : {1U, 2U}) {
    const TemporaryUrdf humanoid(humanoid_urdf(seed), "humanoid");
    expect_agreement_of_floating(humanoid.robot(), 20);
  }
}

}  // namespace
}  // namespace sinew::test
