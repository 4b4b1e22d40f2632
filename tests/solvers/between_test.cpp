// Motion of any frame with respect to any other, seen by any: beside textbook formulas on the
// absolute motions that MuJoCo, DART and KDL compute, and beside derivatives.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <regex>

#include "compare.h"
#include "question.h"

namespace sinew::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using peers::Vector;

cli::QueryOptions options(std::vector<std::string> ask) {
  cli::QueryOptions query;
  query.ask = std::move(ask);
  query.give = {"joint-position", "joint-velocity", "joint-acceleration"};
  query.gravity = "0,0,-9.81";
  return query;
}

std::vector<std::string> links_of(const Robot& robot) {
  std::vector<std::string> links;
  const std::regex link(R"re(<link\s+name="([^"]+)")re");
  for (std::sregex_iterator at(robot.urdf.begin(), robot.urdf.end(), link), end; at != end; ++at)
    if ((*at)[1] != "base") links.push_back((*at)[1]);  // the word means another frame
  return links;
}

// The last of the leaves that move.
std::string tip_of(const Robot& robot) {
  const Question question(robot, "fpk");
  std::string tip;
  for (const program::Variable& variable : question.program().variables)
    if (variable.output) tip = variable.name.substr(variable.name.find('.') + 1);
  return tip;
}

struct Three {
  std::string of, wrt, seen_by;
};

// Anywhere in the tree, always the same; the first from a leaf to the link before the middle one.
std::vector<Three> some_frames(const Robot& robot) {
  const auto links = links_of(robot);
  std::mt19937 random(7);
  std::uniform_int_distribution<std::size_t> any(0, links.size() - 1);
  std::vector<Three> found = {{links.back(), links[links.size() / 2], links[links.size() / 3]}};
  for (int i = 0; i < 4; ++i)
    found.push_back({links[any(random)], links[any(random)], links[any(random)]});
  return found;
}

struct Motion {
  Matrix3d R;
  Vector3d p, w, v, al, a;
};

Vector3d three(const Vector& numbers, std::size_t from) {
  return {numbers[from], numbers[from + 1], numbers[from + 2]};
}

Motion motion_of(peers::Peer& peer, const peers::State& state, const std::string& link) {
  const Vector pose = peer.link_pose(state, link), twist = *peer.quantity(state, "twist", link),
               acceleration = *peer.quantity(state, "acceleration-twist", link);
  Motion m;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      m.R(row, column) = pose[static_cast<std::size_t>(4 * row + column)];
    m.p[row] = pose[static_cast<std::size_t>(4 * row + 3)];
  }
  m.w = three(twist, 0), m.v = three(twist, 3);
  m.al = three(acceleration, 0), m.a = three(acceleration, 3);
  return m;
}

Vector both(const Vector3d& a, const Vector3d& b) { return {a[0], a[1], a[2], b[0], b[1], b[2]}; }

// Of F with respect to G, seen by H.
struct Expected {
  Vector pose, twist, acceleration, spatial;
};

Expected expected(const Motion& f, const Motion& g, const Motion& h) {
  const Vector3d r = f.p - g.p, w = f.w - g.w, v = f.v - g.v - g.w.cross(r);
  const Vector3d al = f.al - g.al - g.w.cross(w);
  const Vector3d a = f.a - g.a - g.al.cross(r) - g.w.cross(g.w.cross(r)) - 2 * g.w.cross(v);
  const Matrix3d R = g.R.transpose() * f.R, to_h = h.R.transpose();
  const Vector3d p = g.R.transpose() * r;
  Expected result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) result.pose.push_back(R(row, column));
    result.pose.push_back(p[row]);
  }
  result.twist = both(to_h * w, to_h * v);
  result.acceleration = both(to_h * al, to_h * a);
  result.spatial = both(to_h * al, to_h * (a - w.cross(v)));
  return result;
}

std::vector<std::unique_ptr<peers::Peer>> peers_of(const Robot& robot, const Question& question) {
  const peers::Setup setup{robot.urdf, question.joints(), false, {0, 0, -9.81}};
  std::vector<std::unique_ptr<peers::Peer>> peers;
  peers.push_back(peers::make_mujoco(setup));
  peers.push_back(peers::make_dart(setup));
  return peers;
}

// The first output of each quantity.
std::map<std::string, Vector> by_quantity(const std::map<std::string, Vector>& answers) {
  std::map<std::string, Vector> found;
  for (const auto& [name, numbers] : answers) found[name.substr(0, name.find('.'))] = numbers;
  return found;
}

// A state of the robot's joints as one of those that a question knows, which may be fewer.
peers::State state_of(const Question& question, const peers::State& all,
                      const std::vector<std::string>& joints) {
  peers::State state;
  for (const std::string& joint : question.joints()) {
    const auto at =
        static_cast<std::size_t>(std::find(joints.begin(), joints.end(), joint) - joints.begin());
    state.position.push_back(all.position[at]);
    state.velocity.push_back(all.velocity[at]);
    state.acceleration.push_back(all.acceleration[at]);
  }
  return state;
}

TEST(Between, AnyTwoFramesAgreesWithAbsoluteMotionsOfMujocoAndDart) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    const Question all(robot, "rnea");
    const auto peers = peers_of(robot, all);
    for (const Three& frames : some_frames(robot)) {
      SCOPED_TRACE(robot.name + ": " + frames.of + " wrt " + frames.wrt + " seen by " +
                   frames.seen_by);
      const std::string pair = " of " + frames.of + " wrt " + frames.wrt,
                        three = pair + " seen-by " + frames.seen_by;
      auto query = options({"pose" + pair, "twist" + three, "acceleration-twist" + three});
      Question moving(robot, query);
      query.ask = {"acceleration-twist" + three};
      query.stationary_frames = true;
      Question stationary(robot, query);
      double pose = 0, twist = 0, acceleration = 0, spatial = 0;
      for (unsigned seed = 0; seed < 200; ++seed) {
        const peers::State state = random_state(all.joints().size(), seed);
        auto ours = by_quantity(moving.answers(state_of(moving, state, all.joints())));
        const Vector ours_spatial =
            stationary.answers(state_of(stationary, state, all.joints())).begin()->second;
        for (const auto& peer : peers) {
          const Expected e =
              expected(motion_of(*peer, state, frames.of), motion_of(*peer, state, frames.wrt),
                       motion_of(*peer, state, frames.seen_by));
          pose = std::max(pose, difference(ours["pose"], e.pose));
          twist = std::max(twist, difference(ours["twist"], e.twist));
          acceleration =
              std::max(acceleration, difference(ours["acceleration-twist"], e.acceleration));
          spatial = std::max(spatial, difference(ours_spatial, e.spatial));
        }
      }
      EXPECT_LT(pose, 1e-10);
      EXPECT_LT(twist, 1e-9);
      EXPECT_LT(acceleration, 1e-9);
      EXPECT_LT(spatial, 1e-9);
    }
  }
}

Vector times(const Vector& matrix, const Vector& vector) {
  const std::size_t n = vector.size();
  Vector result(n == 0 ? 6 : matrix.size() / n, 0.0);
  for (std::size_t i = 0; i < matrix.size(); ++i) result[i / n] += matrix[i] * vector[i % n];
  return result;
}

peers::State moved(const peers::State& state, double time) {
  peers::State later = state;
  for (std::size_t i = 0; i < state.position.size(); ++i)
    later.position[i] += time * state.velocity[i];
  return later;
}

// (f(+h) - f(-h)) / 2 h
template <typename F>
Vector central_difference(F&& f) {
  constexpr double kStep = 1e-5;
  Vector after = f(kStep);
  const Vector before = f(-kStep);
  for (std::size_t i = 0; i < after.size(); ++i) after[i] = (after[i] - before[i]) / (2 * kStep);
  return after;
}

TEST(Between, JacobiansTimesVelocityAreTwistsAndTheirRatesAreDerivatives) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    for (const Three& frames : some_frames(robot)) {
      SCOPED_TRACE(robot.name + ": " + frames.of + " wrt " + frames.wrt + " seen by " +
                   frames.seen_by);
      const std::string pair = " of " + frames.of + " wrt " + frames.wrt,
                        three = pair + " seen-by " + frames.seen_by;
      Question question(
          robot,
          options({"twist" + three, "jacobian" + three, "jacobian-rate-times-velocity" + three,
                   "analytic-jacobian" + pair, "position-and-quaternion" + pair}));
      if (question.joints().empty()) continue;
      for (unsigned seed = 0; seed < 100; ++seed) {
        const peers::State state = random_state(question.joints().size(), seed);
        auto now = by_quantity(question.answers(state));
        EXPECT_LT(difference(times(now["jacobian"], state.velocity), now["twist"]), 1e-12);
        const auto at = [&](const std::string& quantity, double time) {
          return by_quantity(question.answers(moved(state, time)))[quantity];
        };
        const Vector rate = central_difference(
            [&](double time) { return times(at("jacobian", time), state.velocity); });
        EXPECT_LT(difference(now["jacobian-rate-times-velocity"], rate), 1e-7);
        if (std::fabs(now["position-and-quaternion"][6]) < 1e-3) continue;  // where its sign turns
        const Vector coordinates =
            central_difference([&](double time) { return at("position-and-quaternion", time); });
        EXPECT_LT(difference(times(now["analytic-jacobian"], state.velocity), coordinates), 1e-7);
      }
    }
  }
}

TEST(Between, AnalyticJacobianIsTheDerivativeOfTheCoordinates) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    if (robot.name.find("baxter") != std::string::npos) continue;  // large, and nothing new
    const std::string tip = tip_of(robot);
    SCOPED_TRACE(robot.name + ": " + tip);
    auto query = options({"analytic-jacobian of " + tip, "position-and-quaternion of " + tip});
    query.derivatives = {"position-and-quaternion." + tip + "/position"};
    Question question(robot, query);
    for (unsigned seed = 0; seed < 100; ++seed) {
      const peers::State state = random_state(question.joints().size(), seed);
      auto answers = question.answers(state);
      const Vector analytic = answers.at("analytic-jacobian." + tip);
      const std::size_t n = question.joints().size();
      std::size_t found = 0;
      for (std::size_t joint = 0; joint < n; ++joint) {
        for (std::size_t row = 0; row < 7; ++row) {
          // Entries that are zero in every state are left out.
          const auto derivative =
              answers.find("position-and-quaternion." + tip + "[" + std::to_string(row) +
                           "]/position." + question.joints()[joint]);
          const bool there = derivative != answers.end();
          EXPECT_NEAR(there ? derivative->second[0] : 0.0, analytic[row * n + joint], 1e-9);
          found += there;
        }
      }
      EXPECT_GT(found, 0u);
    }
  }
}

TEST(Between, FloatingJacobianTimesVelocityIsTheTwistAndWithItsRateTheAcceleration) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    if (robot.name.find("baxter") != std::string::npos) continue;  // its base has no mass
    const auto links = links_of(robot);
    SCOPED_TRACE(robot.name + ": " + links.back());
    auto query =
        options({"twist of " + links.back(), "acceleration-twist of " + links.back(),
                 "jacobian of " + links.back(), "jacobian-rate-times-velocity of " + links.back()});
    query.floating = true;
    Question question(robot, query);
    for (unsigned seed = 0; seed < 100; ++seed) {
      const peers::State state = random_state(question.joints().size(), seed, true);
      auto now = by_quantity(question.answers(state));
      EXPECT_LT(difference(times(now["jacobian"], state.velocity), now["twist"]), 1e-12);
      Vector acceleration = times(now["jacobian"], state.acceleration);
      for (std::size_t i = 0; i < 6; ++i) acceleration[i] += now["jacobian-rate-times-velocity"][i];
      EXPECT_LT(difference(acceleration, now["acceleration-twist"]), 1e-12);
    }
  }
}

// With respect to the base KDL and DART know it too; MuJoCo of this version does not.
TEST(Agreement, OfTheRateOfTheJacobianWithKdlAndDart) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    SCOPED_TRACE(robot.name);
    auto query = options({"jacobian-rate-times-velocity of every-tip"});
    Question question(robot, query);
    const peers::Setup setup{robot.urdf, question.joints(), false, {0, 0, -9.81}};
    const auto kdl = peers::make_kdl(setup), dart = peers::make_dart(setup);
    double error = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
      const peers::State state = random_state(question.joints().size(), seed);
      for (const auto& [name, numbers] : question.answers(state)) {
        const std::string link = name.substr(name.find('.') + 1);
        for (peers::Peer* peer : {kdl.get(), dart.get()})
          error = std::max(
              error,
              difference(numbers, *peer->quantity(state, "jacobian-rate-times-velocity", link)));
      }
    }
    EXPECT_LT(error, 1e-9);
  }
}

}  // namespace
}  // namespace sinew::test
