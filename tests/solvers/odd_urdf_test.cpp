// URDFs that nobody would draw but somebody will load: chains of slides, links without mass in the
// middle, many fixed links with inertia, a hub of eight limbs, sixty links, a world link at the
// root, planar and floating joints; every solver beside dense matrices in long double, and beside
// KDL, MuJoCo and DART where they know the kind.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "compare.h"
#include "exact_urdf.h"
#include "question.h"
#include "temporary_urdf.h"

namespace sinew::test {
namespace {

using Exact = ExactDynamics<long double>;

struct OddRobot {
  unsigned links = 8, limbs = 1, seed = 1;
  double massless = 0, fixed = 0.2;
  std::vector<std::string> kinds = {"revolute", "continuous", "prismatic"};
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
  std::string origin(double size) {
    return "<origin xyz=\"" + three(size) + "\" rpy=\"" + three(3) + "\"/>";
  }
  std::string link(const std::string& name, bool heavy) {
    if (!heavy) return "<link name=\"" + name + "\"/>\n";
    const double m = number(0.2, 4), x = number(0.05, 0.3), y = number(0.05, 0.3),
                 z = number(0.05, 0.3);
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
                                                : "<axis xyz=\"" + three(1) + "\"/>";
    const bool limited = kind == "revolute" || kind == "prismatic";
    return "<joint name=\"" + name + "\" type=\"" + kind + "\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/>" + origin(0.4) + axis +
           (limited ? "<limit lower=\"-2\" upper=\"2\" effort=\"9\" velocity=\"9\"/>" : "") +
           "</joint>\n";
  }

  OddRobot robot_;
  std::mt19937 random_;
  std::set<std::string> light_;
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
    EXPECT_LT(difference(force, numbers(needed)), 1e-12);
    EXPECT_LT(difference(mass, numbers(exact.mass_matrix())), 1e-10);
    EXPECT_LT(difference(acceleration, numbers(exact.accelerations(long_numbers(force)))), 1e-8);
    const auto poses = fpk.answers(state, force);
    std::size_t found = 0;
    for (std::size_t k = 1; k < reference.robot().links.size(); ++k) {
      const auto pose = poses.find("pose." + reference.robot().links[k].name);
      if (pose == poses.end()) continue;
      Exact::Matrix X(3, 4);
      X << exact.body(k).R, exact.body(k).p;
      EXPECT_LT(difference(pose->second, numbers(X)), 1e-12);
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
