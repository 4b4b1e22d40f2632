#include "random_joints.h"

#include <fmt/format.h>

#include <random>

namespace sinew::test {
namespace {

class Generator {
 public:
  explicit Generator(const RandomJoints& options) : options_(options), random_(options.seed) {}

  TestRobot robot() {
    robot_.links.push_back(link());
    for (unsigned k = 0; k < options_.joints; ++k) {
      robot_.joints.push_back(joint(static_cast<int>(k)));
      robot_.links.push_back(link());
    }
    return std::move(robot_);
  }

 private:
  double number(double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random_);
  }
  bool chance(double probability) { return number(0, 1) < probability; }

  Eigen::Vector3d unit() {
    for (;;) {
      // One after the other: arguments of a call are evaluated in the compiler's own order.
      Eigen::Vector3d v;
      v.z() = number(-1, 1);
      v.y() = number(-1, 1);
      v.x() = number(-1, 1);
      if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
  }
  Eigen::Vector3d axis() {
    if (chance(0.6)) return unit();
    Eigen::Vector3d v = Eigen::Vector3d::Zero();
    v[std::uniform_int_distribution<>(0, 2)(random_)] = 1;
    return v;
  }

  Eigen::Matrix3d rotation() {
    const Eigen::Vector3d about = unit();
    return Eigen::AngleAxisd(number(-3, 3), about).toRotationMatrix();
  }

  TestLink link() {
    TestLink link;
    link.mass = number(0.3, 3);
    link.com = 0.2 * unit();
    const double x = number(0.05, 0.3), y = number(0.05, 0.3), z = number(0.05, 0.3);
    const Eigen::Vector3d moments(y * y + z * z, x * x + z * z, x * x + y * y);
    const Eigen::Matrix3d R = rotation();
    link.inertia = link.mass / 12 * (R * moments.asDiagonal() * R.transpose());
    return link;
  }

  // A joint earlier on that another may follow: one degree of freedom, and itself free.
  int leader_before(int index) {
    std::vector<int> found;
    for (int k = 0; k < index; ++k) {
      const TestJoint& joint = robot_.joints[static_cast<std::size_t>(k)];
      if (joint.velocities == 1 && joint.kind != "composite") found.push_back(k);
    }
    if (found.empty()) return -1;
    return found[std::uniform_int_distribution<std::size_t>(0, found.size() - 1)(random_)];
  }

  TestMotion motion(bool turns, const Eigen::Vector3d& along, int degree) {
    return {turns, along, robot_.velocities + degree, 1, 0};
  }

  TestJoint joint(int index) {
    TestJoint j;
    j.name = "j" + std::to_string(index);
    j.kind = options_.kinds[std::uniform_int_distribution<std::size_t>(
        0, options_.kinds.size() - 1)(random_)];
    j.parent =
        chance(options_.branching) ? std::uniform_int_distribution<>(0, index)(random_) : index;
    j.placement.linear() = rotation();
    j.placement.translation() = 0.3 * unit();
    add_motions(j);
    const bool one = j.kind == "revolute" || j.kind == "prismatic" || j.kind == "helical";
    if (one && options_.rotors && chance(0.3)) {
      j.gear = number(10, 100);
      j.rotor = number(1e-6, 1e-4);
    }
    if (one && options_.couplings && chance(0.4)) j.leader = leader_before(index);
    if (j.leader >= 0) {
      const TestJoint& leader = robot_.joints[static_cast<std::size_t>(j.leader)];
      j.multiplier = number(-1.5, 1.5);
      j.offset = number(-0.5, 0.5);
      for (TestMotion& motion : j.motions) {
        motion.coordinate = leader.velocity;
        motion.offset = motion.ratio * j.offset;
        motion.ratio *= j.multiplier;
      }
    } else {
      j.velocity = robot_.velocities;
      j.position = robot_.positions;
      j.velocities = j.kind == "spherical"  ? 3
                     : j.kind == "floating" ? 6
                     : j.kind == "helical"  ? 1
                                            : static_cast<int>(j.motions.size());
      j.positions = j.velocities + (j.motions.empty() ? 1 : 0);
      robot_.velocities += j.velocities;
      robot_.positions += j.positions;
    }
    return j;
  }

  void add_motions(TestJoint& j) {
    const Eigen::Vector3d a = axis();
    if (j.kind == "revolute") j.motions = {motion(true, a, 0)};
    if (j.kind == "prismatic") j.motions = {motion(false, a, 0)};
    if (j.kind == "cylindrical") j.motions = {motion(true, a, 0), motion(false, a, 1)};
    if (j.kind == "helical") {
      j.pitch = number(-0.2, 0.2);
      j.motions = {motion(true, a, 0), motion(false, a, 0)};
      j.motions[1].ratio = j.pitch;
    }
    if (j.kind == "universal") j.motions = {motion(true, a, 0), motion(true, axis_across(a), 1)};
    if (j.kind == "planar") {
      // About z, where x and y are what one expects.
      j.motions = {motion(false, Eigen::Vector3d::UnitX(), 0),
                   motion(false, Eigen::Vector3d::UnitY(), 1),
                   motion(true, Eigen::Vector3d::UnitZ(), 2)};
    }
    if (j.kind == "composite") {
      const int count = std::uniform_int_distribution<>(1, 4)(random_);
      for (int k = 0; k < count; ++k) {
        const bool turns = chance(0.5);
        // Two turns about one axis would leave the mass matrix without an inverse.
        const Eigen::Vector3d along = k == 0 ? a : axis_across(j.motions.back().axis);
        j.motions.push_back(motion(turns, along, k));
      }
      if (count > 2) {
        // Three slides and no more, or turns in between.
        j.motions[0].turns = true;
        j.motions[1].turns = false;
        j.motions[2].turns = true;
      }
      if (count > 3) j.motions[3].turns = false;
    }
  }

  Eigen::Vector3d axis_across(const Eigen::Vector3d& a) { return a.cross(unit()).normalized(); }

  RandomJoints options_;
  std::mt19937 random_;
  TestRobot robot_;
};

std::string vector(const Eigen::Vector3d& v) {
  return fmt::format("coord:x {:.17e} ; coord:y {:.17e} ; coord:z {:.17e}", v.x(), v.y(), v.z());
}

std::string list(const Eigen::Vector3d& v) {
  return fmt::format("( {:.17e} {:.17e} {:.17e} )", v.x(), v.y(), v.z());
}

std::string frame(const std::string& name) {
  return fmt::format(":{0} a geom:Frame ; geom:origin :{0}-origin .\n:{0}-origin a geom:Point .\n",
                     name);
}

std::string link(const TestRobot& robot, std::size_t k) {
  const TestLink& l = robot.links[k];
  const std::string name = "link" + std::to_string(k);
  std::string simplices = fmt::format(":{0}-root, :{0}-root-origin, :{0}-com", name);
  std::string text = frame(name + "-root");
  for (const TestJoint& j : robot.joints) {
    if (j.parent != static_cast<int>(k)) continue;
    const Eigen::Matrix3d R = j.placement.linear();
    simplices += fmt::format(", :{0}-at, :{0}-at-origin", j.name);
    text += frame(j.name + "-at");
    text += fmt::format(
        ":{0}-pose a rel:Pose ; rel:of :{0}-at ; rel:with-respect-to :{1}-root .\n"
        ":{0}-pose-c a coord:PoseCoordinate ; coord:of-pose :{0}-pose ; coord:as-seen-by :{1}-root "
        "; qudt:unit unit:UNITLESS, unit:M ; coord:direction-cosine-x {2} ; "
        "coord:direction-cosine-y {3} ; coord:direction-cosine-z {4} ; {5} .\n",
        j.name, name, list(R.col(0)), list(R.col(1)), list(R.col(2)),
        vector(j.placement.translation()));
  }
  text += fmt::format(
      ":{0} a geom:SimplicialComplex, geom:RigidBody ; geom:simplices {1} .\n"
      ":{0}-com a geom:Point .\n"
      ":{0}-com-p a rel:Position ; rel:of :{0}-com ; rel:with-respect-to :{0}-root-origin .\n"
      ":{0}-com-c a coord:PositionCoordinate ; coord:of-position :{0}-com-p ; coord:as-seen-by "
      ":{0}-root ; qudt:unit unit:M ; {2} .\n"
      ":{0}-i a dyn:RigidBodyInertia ; dyn:of-body :{0} ; dyn:about :{0}-com .\n",
      name, simplices, vector(l.com));
  const Eigen::Matrix3d& I = l.inertia;
  text += fmt::format(
      ":{0}-i-c a dync:RigidBodyInertiaCoordinate ; dync:of-inertia :{0}-i ; dync:as-seen-by "
      ":{0}-root ; qudt:unit unit:KiloGM, unit:M-KiloGM, unit:KiloGM-M2 ; dync:mass {1:.17e} ; "
      "dync:first-moment-of-mass (0 0 0) ; dync:ixx {2:.17e} ; dync:ixy {3:.17e} ; dync:ixz "
      "{4:.17e} ; dync:iyy {5:.17e} ; dync:iyz {6:.17e} ; dync:izz {7:.17e} .\n",
      name, l.mass, I(0, 0), I(0, 1), I(0, 2), I(1, 1), I(1, 2), I(2, 2));
  return text;
}

// A line in both attachments, by its direction.
std::string axis(const std::string& name, const std::string& joint, const std::string& child,
                 const Eigen::Vector3d& direction) {
  std::string text =
      fmt::format(":{0} a rel:LineCollinearity ; rel:lines :{0}-p, :{0}-c .\n", name);
  const std::pair<std::string, std::string> lines[] = {{"p", joint + "-at"}, {"c", child}};
  for (const auto& [end, at] : lines) {
    text += fmt::format(
        ":{0}-{1} a geom:Vector, geom:BoundVector ; geom:start :{2}-origin .\n"
        ":{0}-{1}-c a coord:DirectionCoordinate ; sg:of-direction :{0}-{1} ; coord:as-seen-by :{2} "
        "; qudt:unit unit:UNITLESS ; {3} .\n",
        name, end, at, vector(direction));
  }
  return text;
}

std::string type_of(const std::string& kind) {
  if (kind == "revolute") return "kc:RevoluteJoint";
  std::string name = kind;
  name[0] = static_cast<char>(std::toupper(name[0]));
  return "skc:" + name + "Joint";
}

std::string joint(const TestRobot& robot, std::size_t k) {
  const TestJoint& j = robot.joints[k];
  const std::string child = "link" + std::to_string(k + 1) + "-root";
  std::string text = fmt::format(
      ":{0} a kc:Joint, {1} ; kc:between-attachments :{0}-at, :{2} ; kc:origin-offset :{0}-offset "
      ".\n:{0}-offset a rel:Position ; rel:of :{2}-origin ; rel:with-respect-to :{0}-at-origin .\n",
      j.name, type_of(j.kind), child);
  if (j.kind == "universal" || j.kind == "composite") {
    std::string nodes;
    for (std::size_t m = 0; m < j.motions.size(); ++m) {
      const std::string node = fmt::format("{}-m{}", j.name, m);
      nodes += " :" + node;
      text += fmt::format(":{0} a skc:{1} ; kc:common-axis :{0}-axis .\n", node,
                          j.motions[m].turns ? "RevoluteMotion" : "PrismaticMotion");
      text += axis(node + "-axis", j.name, child, j.motions[m].axis);
    }
    text += fmt::format(":{} skc:sequence ({} ) .\n", j.name, nodes);
  } else if (!j.motions.empty()) {
    text += fmt::format(":{0} kc:common-axis :{0}-axis .\n", j.name) +
            axis(j.name + "-axis", j.name, child, j.motions.back().axis);
  }
  if (j.kind == "helical") {
    text += fmt::format(
        ":{0}-pitch a skc:JointPitch ; kc-stat:of-joint :{0} ; skc:pitch {1:.17e} ; qudt:unit "
        "unit:M-PER-RAD .\n",
        j.name, j.pitch);
  }
  if (j.leader >= 0) {
    text += fmt::format(
        ":{0}-mimicry a skc:JointMimicry ; kc-stat:of-joint :{0} ; skc:mimics :{1} ; "
        "skc:multiplier {2:.17e} ; skc:offset {3:.17e} ; qudt:unit unit:{4} .\n",
        j.name, robot.joints[static_cast<std::size_t>(j.leader)].name, j.multiplier, j.offset,
        j.kind == "prismatic" ? "M" : "RAD");
  }
  if (j.rotor > 0) {
    text += fmt::format(
        ":{0}-gear a skc:JointTransmission ; kc-stat:of-joint :{0} ; skc:ratio {1:.17e} ; "
        "skc:rotor-inertia {2:.17e} ; qudt:unit unit:KiloGM-M2 .\n",
        j.name, j.gear, j.rotor);
  }
  return text;
}

constexpr std::string_view kPrefixes = R"(
@prefix : <https://example.org/r#> .
@prefix geom: <https://comp-rob2b.github.io/metamodels/geometry/structural-entities#> .
@prefix rel: <https://comp-rob2b.github.io/metamodels/geometry/spatial-relations#> .
@prefix coord: <https://comp-rob2b.github.io/metamodels/geometry/coordinates#> .
@prefix kc: <https://comp-rob2b.github.io/metamodels/kinematic-chain/structural-entities#> .
@prefix kc-stat: <https://comp-rob2b.github.io/metamodels/kinematic-chain/state#> .
@prefix skc: <https://w3id.org/sinew/kinematic-chain#> .
@prefix sg: <https://w3id.org/sinew/geometry#> .
@prefix dyn: <https://comp-rob2b.github.io/metamodels/newtonian-rigid-body-dynamics/structural-entities#> .
@prefix dync: <https://comp-rob2b.github.io/metamodels/newtonian-rigid-body-dynamics/coordinates#> .
@prefix qudt: <http://qudt.org/schema/qudt/> .
@prefix unit: <http://qudt.org/vocab/unit/> .
)";

}  // namespace

TestRobot random_joints(const RandomJoints& options) { return Generator(options).robot(); }

TestRobot behind_a_floating_joint(const TestRobot& robot) {
  TestRobot floating;
  floating.links.push_back({});
  floating.links.insert(floating.links.end(), robot.links.begin(), robot.links.end());
  TestJoint base;
  base.name = "base";
  base.kind = "floating";
  base.velocities = 6;
  base.positions = 7;
  floating.joints.push_back(base);
  for (TestJoint joint : robot.joints) {
    ++joint.parent;
    if (joint.leader >= 0) ++joint.leader;
    joint.velocity += 6;
    joint.position += 7;
    for (TestMotion& motion : joint.motions) motion.coordinate += 6;
    floating.joints.push_back(joint);
  }
  floating.velocities = robot.velocities + 6;
  floating.positions = robot.positions + 7;
  return floating;
}

std::string turtle(const TestRobot& robot) {
  std::string text(kPrefixes);
  for (std::size_t k = 0; k < robot.links.size(); ++k) text += link(robot, k);
  for (std::size_t k = 0; k < robot.joints.size(); ++k) text += joint(robot, k);
  return text;
}

}  // namespace sinew::test
