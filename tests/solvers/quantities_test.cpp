// What else can be asked of a robot, beside the answers of libraries that no one here wrote; and
// the identities that tie the answers to each other.
#include <gtest/gtest.h>

#include <map>

#include "compare.h"
#include "question.h"

namespace sinew::test {
namespace {

constexpr unsigned kStates = 1000;

bool floats_well(const Robot& robot) {  // its first link has mass, as a body that floats must
  return robot.name.ends_with("hyq.urdf") || robot.name == "gen3_7dof.urdf" ||
         robot.name == "iiwa.urdf";
}

std::vector<std::unique_ptr<peers::Peer>> peers_of(const Robot& robot, const Question& question,
                                                   bool floating) {
  const peers::Setup setup{robot.urdf, question.joints(), floating, {0, 0, -9.81}};
  std::vector<std::unique_ptr<peers::Peer>> peers;
  peers.push_back(peers::make_mujoco(setup));
  peers.push_back(peers::make_dart(setup));
  if (!floating) peers.push_back(peers::make_kdl(setup));
  return peers;
}

// The largest relative difference of each output from that of each peer that has it, and how many
// peers had it.
struct Agreement {
  double error = 0;
  std::size_t peers = 0;
};

// Outputs QUANTITY, or QUANTITY.LINK.
std::map<std::string, Agreement> agreement(const Robot& robot, const std::string& solver,
                                           bool floating, unsigned states) {
  Question question(robot, solver, floating);
  const auto peers = peers_of(robot, question, floating);
  std::map<std::string, Agreement> found;
  for (unsigned seed = 0; seed < states; ++seed) {
    const peers::State state = random_state(question.joints().size(), seed, floating);
    for (const auto& [name, numbers] : question.answers(state)) {
      const std::size_t dot = name.find('.');
      const std::string quantity = name.substr(0, dot);
      const std::string link = dot == std::string::npos ? "" : name.substr(dot + 1);
      Agreement& one = found[quantity];
      std::size_t answered = 0;
      for (const auto& peer : peers) {
        const auto theirs = peer->quantity(state, quantity, link);
        if (!theirs) continue;
        ++answered;
        one.error = std::max(one.error, difference(numbers, *theirs));
      }
      one.peers = seed == 0 ? answered : std::min(one.peers, answered);
    }
  }
  return found;
}

void expect_agreement(const std::string& solver, double tolerance) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    for (const bool floating : {false, true}) {
      if (floating && !floats_well(robot)) continue;
      for (const auto& [quantity, one] :
           agreement(robot, solver, floating, floating ? kStates / 4 : kStates)) {
        SCOPED_TRACE(robot.name + (floating ? ", floating: " : ": ") + quantity);
        EXPECT_LT(one.error, tolerance);
        EXPECT_GE(one.peers, 2u);
      }
    }
  }
}

TEST(Agreement, OfTheCenterOfMassItsVelocityAndJacobian) { expect_agreement("com", 1e-9); }
TEST(Agreement, OfMomentumAndTheCentroidalMomentumMatrix) { expect_agreement("momentum", 1e-9); }
TEST(Agreement, OfKineticAndPotentialEnergy) { expect_agreement("energy", 1e-9); }
TEST(Agreement, OfTwists) { expect_agreement("fvk", 1e-9); }
TEST(Agreement, OfAccelerationTwists) { expect_agreement("fak", 1e-9); }
TEST(Agreement, OfJacobians) { expect_agreement("jacobian", 1e-9); }

}  // namespace
}  // namespace sinew::test
