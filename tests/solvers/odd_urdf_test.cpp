// URDFs that nobody would draw but somebody will load: chains of slides, links without mass in the
// middle, many fixed links with inertia, a hub of eight limbs, sixty links, a world link at the
// root, planar and floating joints, axes that are parallel but for a rounded pi, a gram behind
// tonnes, robots of a tenth of a millimetre; every solver beside dense matrices in long double, and
// beside KDL, MuJoCo and DART where they know the kind.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "compare.h"
#include "exact_urdf.h"
#include "question.h"
#include "sinew/base/error.h"
#include "sinew/program/scalar_program.h"
#include "temporary_urdf.h"

namespace sinew::test {
namespace {

using Exact = ExactDynamics<long double>;

struct OddRobot {
  unsigned links = 8, limbs = 1, seed = 1;
  double massless = 0, fixed = 0.2;
  std::vector<std::string> kinds = {"revolute", "continuous", "prismatic"};
  double tilt = 0;  // axes are those of the frames but for this; turns are pi/2 with four digits
  double size = 1;  // lengths of about half a metre, times this
  std::vector<double> masses = {1};  // of links in turn, times about two kilogrammes
};

class Generator {
 public:
  explicit Generator(const OddRobot& robot) : robot_(robot), random_(robot.seed) {}

  std::string urdf() {
    std::string text = "<robot name=\"odd\">\n<link name=\"world\"/>\n";
    text += link("hub", true) + joint("held", "fixed", "world", "hub");
    std::vector<std::string> ends(robot_.limbs, "hub");
    for (unsigned k = 0; k < robot_.links; ++k) {
      std::string& end = ends[k % robot_.limbs];
      const std::string name = "l" + std::to_string(k);
      const bool last = k + robot_.limbs >= robot_.links;
      // What has no mass is followed by what has.
      const bool heavy = last || light_.contains(end) || number(0, 1) >= robot_.massless;
      if (!heavy) light_.insert(name);
      const bool fixed = heavy && !last && number(0, 1) < robot_.fixed;
      const std::string kind = fixed ? "fixed" : robot_.kinds[random_() % robot_.kinds.size()];
      text += link(name, heavy) + joint("j" + std::to_string(k), kind, end, name);
      end = name;
    }
    return text + "</robot>\n";
  }

 private:
  double number(double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random_);
  }
  std::string three(double size) {
    return fmt::format("{} {} {}", number(-size, size), number(-size, size), number(-size, size));
  }
  std::string angles() {
    if (robot_.tilt == 0) return three(3);
    const char* turns[] = {"0 0 0", "1.5708 0 0", "3.1416 0 0", "-1.5708 0 1.5708"};
    return turns[random_() % 4];
  }
  std::string direction() {
    if (robot_.tilt == 0) return three(1);
    return fmt::format("{} {} 1", number(-1, 1) * robot_.tilt, number(-1, 1) * robot_.tilt);
  }
  std::string origin(double size) {
    return "<origin xyz=\"" + three(size * robot_.size) + "\" rpy=\"" + angles() + "\"/>";
  }
  std::string link(const std::string& name, bool heavy) {
    if (!heavy) return "<link name=\"" + name + "\"/>\n";
    const double m = number(0.2, 4) * robot_.masses[links_++ % robot_.masses.size()],
                 x = number(0.05, 0.3) * robot_.size, y = number(0.05, 0.3) * robot_.size,
                 z = number(0.05, 0.3) * robot_.size;
    return fmt::format(
        "<link name=\"{}\"><inertial>{}<mass value=\"{}\"/><inertia ixx=\"{}\" iyy=\"{}\" "
        "izz=\"{}\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n",
        name, origin(0.2), m, m * (y * y + z * z) / 12, m * (x * x + z * z) / 12,
        m * (x * x + y * y) / 12);
  }
  std::string joint(const std::string& name, const std::string& kind, const std::string& parent,
                    const std::string& child) {
    const std::string axis = kind == "fixed" || kind == "floating" ? ""
                             : kind == "planar"                    ? "<axis xyz=\"0 0 1\"/>"
                                                : "<axis xyz=\"" + direction() + "\"/>";
    const bool limited = kind == "revolute" || kind == "prismatic";
    return "<joint name=\"" + name + "\" type=\"" + kind + "\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/>" + origin(0.4) + axis +
           (limited ? "<limit lower=\"-2\" upper=\"2\" effort=\"9\" velocity=\"9\"/>" : "") +
           "</joint>\n";
  }

  OddRobot robot_;
  std::mt19937 random_;
  std::set<std::string> light_;
  std::size_t links_ = 0;
};

// Of all joints with numbers, those of several too, in the order of the inputs.
std::vector<std::string> joints_of(const program::Program& program) {
  std::vector<std::string> joints;
  for (const program::Slot& slot : program::interface_of(program).inputs) {
    const std::string& name = program.variables[slot.variable].name;
    if (name.starts_with("position.")) joints.push_back(name.substr(9));
  }
  return joints;
}

peers::State random_state_of(const program::Program& program, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<> number(-1, 1);
  peers::State state;
  for (const program::Slot& slot : program::interface_of(program).inputs) {
    const program::Variable& v = program.variables[slot.variable];
    if (!v.name.starts_with("position.")) continue;
    const std::size_t first = state.position.size();
    for (std::uint32_t k = 0; k < v.size; ++k) state.position.push_back(number(random));
    double square = 0;
    for (std::size_t k = 3; v.size == 7 && k < 7; ++k)
      square += state.position[first + k] * state.position[first + k];
    for (std::size_t k = 3; v.size == 7 && k < 7; ++k)
      state.position[first + k] /= std::sqrt(square);
    for (std::uint32_t k = 0; k < (v.size == 7 ? 6 : v.size); ++k) {
      state.velocity.push_back(number(random));
      state.acceleration.push_back(number(random));
    }
  }
  return state;
}

Exact::Vector long_numbers(const peers::Vector& from) {
  return Eigen::Map<const Eigen::VectorXd>(from.data(), static_cast<Eigen::Index>(from.size()))
      .cast<long double>();
}

peers::Vector numbers(const Exact::Matrix& from) {  // row by row
  peers::Vector result;
  for (Eigen::Index r = 0; r < from.rows(); ++r)
    for (Eigen::Index c = 0; c < from.cols(); ++c)
      result.push_back(static_cast<double>(from(r, c)));
  return result;
}

void expect_agreement(const OddRobot& odd, bool with_peers, unsigned states = 5) {
  SCOPED_TRACE(testing::Message() << odd.links << " links, seed " << odd.seed);
  const TemporaryUrdf file(Generator(odd).urdf(), "odd");
  const Robot& robot = file.robot();
  Question rnea(robot, "rnea"), crba(robot, "crba"), aba(robot, "aba"), fpk(robot, "fpk");
  const ExactUrdf<long double> reference(robot.urdf, joints_of(rnea.program()), false);
  std::vector<std::unique_ptr<peers::Peer>> others;
  if (with_peers) {
    const peers::Setup setup{robot.urdf, rnea.joints(), false, {0, 0, -9.81}};
    others.push_back(peers::make_kdl(setup));
    others.push_back(peers::make_mujoco(setup));
    others.push_back(peers::make_dart(setup));
  }
  for (unsigned seed = 0; seed < states; ++seed) {
    const peers::State state = random_state_of(rnea.program(), seed);
    const Exact exact(reference.robot(), {0, 0, -9.81}, long_numbers(state.position),
                      long_numbers(state.velocity));
    const Exact::Vector needed =
        exact.mass_matrix() * long_numbers(state.acceleration) + exact.bias();
    const peers::Vector force = rnea.answer(state), mass = crba.answer(state),
                        acceleration = aba.answer(state, force);
    // Entries of a rotation may be taken for 0 or 1 within 1e-12, for each joint on the way.
    const double snapped = odd.tilt > 0 ? 1e-11 : 1e-12;
    EXPECT_LT(difference(force, numbers(needed)), snapped);
    EXPECT_LT(difference(mass, numbers(exact.mass_matrix())), 1e-10);
    EXPECT_LT(difference(acceleration, numbers(exact.accelerations(long_numbers(force)))), 1e-8);
    const auto poses = fpk.answers(state, force);
    std::size_t found = 0;
    for (std::size_t k = 1; k < reference.robot().links.size(); ++k) {
      const auto pose = poses.find("pose." + reference.robot().links[k].name);
      if (pose == poses.end()) continue;
      Exact::Matrix X(3, 4);
      X << exact.body(k).R, exact.body(k).p;
      EXPECT_LT(difference(pose->second, numbers(X)), snapped);
      ++found;
    }
    EXPECT_EQ(found, odd.limbs);  // the tips
    for (const auto& other : others) {
      EXPECT_LT(difference(force, other->inverse_dynamics(state)), 1e-9) << other->name();
      EXPECT_LT(difference(mass, other->mass_matrix(state)), 1e-9) << other->name();
      if (other->name() != "KDL") {
        EXPECT_LT(difference(acceleration, other->forward_dynamics(state, force)), 1e-8)
            << other->name();
      }
    }
  }
}

TEST(OddUrdf, ChainsOfSlidesAgree) {
  for (const unsigned links : {2u, 3u, 6u, 12u})
    expect_agreement({.links = links, .seed = links, .fixed = 0, .kinds = {"prismatic"}}, true);
}

TEST(OddUrdf, HubsOfEightLimbsAgree) {
  for (const unsigned links : {8u, 24u, 60u})
    expect_agreement({.links = links, .limbs = 8, .seed = links}, true, 3);
}

TEST(OddUrdf, SixtyLinksInARowAgree) {
  expect_agreement({.links = 60, .seed = 5, .fixed = 0.5}, true, 2);
}

// MuJoCo and DART ask for some mass of every link, so these are for the dense matrices alone.
TEST(OddUrdf, LinksWithoutMassInTheMiddleAgree) {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u})
    expect_agreement({.links = 12, .limbs = 2, .seed = seed, .massless = 0.6}, false);
}

// The common normal of two such axes is as far away as their angle is small; and the next double
// after 1 is further from it than these tilts are long.
TEST(OddUrdf, AxesThatAreNearlyParallelAgree) {
  for (const double tilt : {1e-13, 2e-11, 3e-8, 1e-6, 1e-3}) {
    SCOPED_TRACE(tilt);
    for (const unsigned seed : {1u, 2u, 3u}) {
      expect_agreement({.links = 7, .seed = seed, .kinds = {"revolute"}, .tilt = tilt}, false);
      expect_agreement({.links = 9, .limbs = 2, .seed = seed, .tilt = tilt}, false);
    }
  }
}

// Each joint's force by itself: beside the crane's, nothing of the finger's could be seen.
TEST(OddUrdf, LightLinksBehindHeavyOnesKeepTheirInertia) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    const TemporaryUrdf file(
        Generator({.links = 6, .seed = seed, .fixed = 0, .masses = {1e6, 1e6, 1e6, 1, 1e-9, 1e-9}})
            .urdf(),
        "odd");
    const Robot& robot = file.robot();
    Question rnea(robot, "rnea");
    const ExactUrdf<long double> reference(robot.urdf, joints_of(rnea.program()), false);
    const peers::State state = random_state_of(rnea.program(), seed);
    const Exact exact(reference.robot(), {0, 0, -9.81}, long_numbers(state.position),
                      long_numbers(state.velocity));
    const peers::Vector needed =
        numbers(exact.mass_matrix() * long_numbers(state.acceleration) + exact.bias());
    // As code has it, with what counts as round-off removed.
    peers::Vector in = state.position;
    in.insert(in.end(), state.velocity.begin(), state.velocity.end());
    in.insert(in.end(), state.acceleration.begin(), state.acceleration.end());
    const peers::Vector force =
        program::evaluate(program::scalar_program(rnea.program()).computation, in);
    ASSERT_EQ(force.size(), needed.size());
    for (std::size_t k = 0; k < force.size(); ++k)
      EXPECT_NEAR(force[k], needed[k], 1e-9 * std::abs(needed[k])) << "seed " << seed << ", " << k;
    expect_agreement({.links = 6, .seed = seed, .fixed = 0, .masses = {1e3, 1, 1e-3}}, false);
  }
}

TEST(OddUrdf, RobotsOfATenthOfAMillimetreAgree) {
  for (const double size : {1e-2, 1e-4}) {
    SCOPED_TRACE(size);
    expect_agreement({.links = 8, .limbs = 2, .seed = 3, .kinds = {"revolute"}, .size = size},
                     false);
  }
}

// Nothing resists a turn of what lies between two joints on one axis.
TEST(OddUrdf, WhatNoForceCouldAccelerateIsRefusedByForwardDynamicsOnly) {
  const std::string between = "<link name=\"between\"/>\n";
  const std::string joints =
      "<joint name=\"j1\" type=\"continuous\"><parent link=\"base\"/><child link=\"between\"/>"
      "<axis xyz=\"0 0 1\"/></joint>"
      "<joint name=\"j2\" type=\"continuous\"><parent link=\"between\"/><child link=\"tip\"/>"
      "<axis xyz=\"0 0 1\"/></joint>";
  const std::string tip =
      "<link name=\"tip\"><inertial><origin xyz=\"0.1 0.2 0.3\"/><mass value=\"1.3\"/>"
      "<inertia ixx=\"0.1\" iyy=\"0.17\" izz=\"0.13\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>"
      "</link>";
  const TemporaryUrdf file(
      "<robot name=\"odd\"><link name=\"base\"/>" + between + tip + joints + "</robot>", "odd");
  for (const char* solver : {"rnea", "crba", "cholesky"})
    EXPECT_NO_THROW(program::scalar_program(Question(file.robot(), solver).program())) << solver;
  for (const char* solver : {"aba", "forward_cholesky"}) {
    try {
      program::scalar_program(Question(file.robot(), solver).program());
      ADD_FAILURE() << solver << " was made";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("divides by zero")) << solver;
    }
  }
}

// URDF's planar and floating joints are none of KDL's and MuJoCo's readers.
TEST(OddUrdf, PlanarAndFloatingJointsAgree) {
  for (const unsigned seed : {1u, 2u, 3u, 4u})
    expect_agreement({.links = 6,
                      .limbs = 2,
                      .seed = seed,
                      .kinds = {"planar", "floating", "revolute", "prismatic"}},
                     false);
}

}  // namespace
}  // namespace sinew::test
