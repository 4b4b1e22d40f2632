// What else can be asked of a robot, beside the answers of libraries that no one here wrote; and
// the identities that tie the answers to each other.
#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "compare.h"
#include "question.h"

namespace sinew::test {
namespace {

constexpr unsigned kStates = 1000;

std::vector<std::unique_ptr<peers::Peer>> peers_of(const Robot& robot, const Question& question,
                                                   bool floating) {
  const peers::Setup setup{robot.urdf, question.joints(), floating, {0, 0, -9.81}};
  std::vector<std::unique_ptr<peers::Peer>> peers;
  peers.push_back(peers::make_mujoco(setup));
  peers.push_back(peers::make_dart(setup));
  if (!floating) peers.push_back(peers::make_kdl(setup));
  return peers;
}

cli::QueryOptions options(const std::string& solver, bool floating = false) {
  cli::QueryOptions query;
  query.solver = solver;
  query.gravity = "0,0,-9.81";
  query.floating = floating;
  return query;
}

// The largest relative difference of each output from that of each peer that has it, and how many
// peers had it.
struct Agreement {
  double error = 0;
  std::size_t peers = 0;
};

// Outputs QUANTITY, or QUANTITY.LINK.
std::map<std::string, Agreement> agreement(const Robot& robot, const cli::QueryOptions& query,
                                           unsigned states) {
  const bool floating = query.floating;
  Question question(robot, query);
  const auto peers = peers_of(robot, question, floating);
  std::map<std::string, Agreement> found;
  for (unsigned seed = 0; seed < states; ++seed) {
    const peers::State state = random_state(question.joints().size(), seed, floating);
    for (const auto& [name, numbers] : question.answers(state)) {
      const std::size_t dot = name.find('.');
      const std::string quantity = name.substr(0, dot);
      if (quantity == "force") continue;  // agreement_test.cpp
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

void expect_agreement(cli::QueryOptions query, double tolerance) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    for (const bool floating : {false, true}) {
      query.floating = floating;
      for (const auto& [quantity, one] : agreement(robot, query, kStates)) {
        SCOPED_TRACE(robot.name + (floating ? ", floating: " : ": ") + quantity);
        EXPECT_LT(one.error, tolerance);
        EXPECT_GE(one.peers, 2u);
      }
    }
  }
}

TEST(Agreement, OfTheCenterOfMassItsVelocityAndJacobian) { expect_agreement(options("com"), 1e-9); }
TEST(Agreement, OfMomentumAndTheCentroidalMomentumMatrix) {
  expect_agreement(options("momentum"), 1e-9);
}
TEST(Agreement, OfKineticAndPotentialEnergy) { expect_agreement(options("energy"), 1e-9); }
TEST(Agreement, OfTwists) { expect_agreement(options("fvk"), 1e-9); }
TEST(Agreement, OfAccelerationTwists) { expect_agreement(options("fak"), 1e-9); }
TEST(Agreement, OfJacobians) { expect_agreement(options("jacobian"), 1e-9); }

// What a bearing carries; seen from the link behind the joint.
TEST(Agreement, OfTheWholeWrenchOfEachJoint) {
  cli::QueryOptions query = options("rnea");
  query.ask = {"joint-wrench of every-joint"};
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    for (const bool floating : {false, true}) {
      query.floating = floating;
      const auto found = agreement(robot, query, kStates);
      SCOPED_TRACE(robot.name + (floating ? ", floating" : ""));
      EXPECT_LT(found.at("joint-wrench").error, 1e-9);
      EXPECT_GE(found.at("joint-wrench").peers, 2u);
    }
  }
}

// The link of the first joint's successor, and that of a leaf.
std::vector<std::string> links_to_push(const Robot& robot) {
  std::vector<std::string> links;
  const Question question(robot, "fpk");
  for (const program::Variable& variable : question.program().variables)
    if (variable.output) links.push_back(variable.name.substr(variable.name.find('.') + 1));
  return {links.front(), links.back()};
}

peers::Vector random_wrench(unsigned seed) {
  const peers::State state = random_state(6, seed + 77777);
  return state.acceleration;
}

peers::Vector plus(const peers::Vector& a, const peers::Vector& b, double factor = 1) {
  peers::Vector sum(a);
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] += factor * b[i];
  return sum;
}

TEST(ExternalWrench, HelpsAsKdlMujocoAndDartSayAndForwardDynamicsUndoesIt) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    for (const bool floating : {false, true}) {
      SCOPED_TRACE(robot.name + (floating ? ", floating" : ""));
      const std::string link = links_to_push(robot).back();
      cli::QueryOptions inverse = options("rnea", floating), forward = options("aba", floating);
      inverse.give = forward.give = {"external-wrench of " + link};
      Question rnea(robot, inverse);
      // Forces do not say how a base without mass moves.
      std::optional<Question> aba;
      if (!floating || !robot.name.starts_with("clean/") || robot.name == "clean/hyq.urdf")
        aba.emplace(robot, forward);
      const auto peers = peers_of(robot, rnea, floating);
      double error = 0, round_trip = 0;
      for (unsigned seed = 0; seed < kStates; ++seed) {
        const peers::State state = random_state(rnea.joints().size(), seed, floating);
        const peers::Vector wrench = random_wrench(seed);
        rnea.set("wrench." + link, wrench);
        if (aba) aba->set("wrench." + link, wrench);
        const peers::Vector force = rnea.answer(state);
        for (const auto& peer : peers)
          error =
              std::max(error, difference(force, peer->inverse_dynamics_under(state, link, wrench)));
        if (aba)
          round_trip =
              std::max(round_trip, difference(aba->answer(state, force), state.acceleration));
      }
      EXPECT_LT(error, 1e-9);
      EXPECT_LT(round_trip, 1e-8);
    }
  }
}

TEST(ExternalWrench, SeenFromTheBaseIsTheSameWrenchTurned) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    SCOPED_TRACE(robot.name);
    const std::string link = links_to_push(robot).back();
    cli::QueryOptions query = options("rnea");
    query.give = {"external-wrench of " + link};
    Question own(robot, query);
    query.give = {"external-wrench of " + link + " seen-by base"};
    Question turned(robot, query);
    const auto dart = peers::make_dart({robot.urdf, own.joints(), false, {0, 0, -9.81}});
    for (unsigned seed = 0; seed < 50; ++seed) {
      const peers::State state = random_state(own.joints().size(), seed);
      const peers::Vector wrench = random_wrench(seed), pose = dart->link_pose(state, link);
      peers::Vector in_base(6);
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          in_base[i] += pose[4 * (i % 3) + k] * wrench[3 * (i / 3) + k];
      own.set("wrench." + link, wrench);
      turned.set("wrench." + link, in_base);
      EXPECT_LT(difference(turned.answer(state), own.answer(state)), 1e-12);
    }
  }
}

TEST(ExternalWrench, KeptApartShowsItsShareOfEachJointsForce) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    SCOPED_TRACE(robot.name);
    const auto links = links_to_push(robot);
    cli::QueryOptions query = options("rnea");
    Question without(robot, query);
    query.give = {"external-wrench of " + links.front()};
    if (links.back() != links.front()) query.give.push_back("external-wrench of " + links.back());
    Question together(robot, query);
    query.ask = {"joint-force-share of every-joint"};
    query.forces_apart = true;
    Question apart(robot, query);
    for (unsigned seed = 0; seed < 50; ++seed) {
      const peers::State state = random_state(without.joints().size(), seed);
      for (const std::string& link : links)
        for (Question* question : {&together, &apart})
          question->set("wrench." + link, random_wrench(seed + (link == links.front() ? 0 : 1000)));
      const auto sums = together.answers(state), own = without.answers(state);
      auto shares = apart.answers(state);
      std::size_t found = 0;
      for (const std::string& joint : without.joints()) {
        peers::Vector sum = own.at("force." + joint);
        for (const std::string& link : links) {
          const auto share = shares.find("force-share." + joint + "." + link);
          if (share == shares.end()) continue;
          sum = plus(sum, share->second);
          shares.erase(share);
          ++found;
        }
        EXPECT_LT(difference(shares.at("force." + joint), sums.at("force." + joint)), 1e-10);
        EXPECT_LT(difference(sum, sums.at("force." + joint)), 1e-10);
      }
      EXPECT_GT(found, 0u);
    }
  }
}

TEST(Gravity, ThatComesWithEachCallIsThatOfTheModel) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    SCOPED_TRACE(robot.name);
    cli::QueryOptions query = options("rnea,gravity,energy,fak");
    query.gravity = "1.5,-2,-9.5";
    Question constant(robot, query);
    query.gravity = "input";
    Question varying(robot, query);
    varying.set("gravity", {1.5, -2, -9.5});
    for (unsigned seed = 0; seed < 50; ++seed) {
      const peers::State state = random_state(constant.joints().size(), seed);
      EXPECT_LT(difference(varying.answer(state), constant.answer(state)), 1e-12);
    }
  }
}

}  // namespace
}  // namespace sinew::test
