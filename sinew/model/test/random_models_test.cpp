// One robot, said twice: as a URDF, whose reading other tests compare with KDL, and as a linked
// model that says the same in its own ways. Poses go over frames in between, in either direction,
// in millimetres or feet, or as an orientation and a position; inertias are about the centre of
// mass, the link's origin or another frame, seen from that frame, in grams and square centimetres;
// joints state their attachments in any order, slide or turn about their axis or against it. Both
// move alike.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "newton_euler.h"
#include "sinew/model/inertia.h"
#include "sinew/model/rotation.h"
#include "small_models.h"

namespace sinew::model::test {
namespace {

std::string text(double number) { return fmt::format("{:.17g}", number); }

std::string list(const Vector3& v) {
  return "(" + text(v.x) + " " + text(v.y) + " " + text(v.z) + ")";
}

struct LengthUnit {
  const char* name;
  double metres;
};
constexpr LengthUnit kLengths[] = {{"M", 1}, {"MilliM", 1e-3}, {"CentiM", 1e-2}, {"FT", 0.3048}};

// A robot as a chain, in the terms of a URDF.
struct Robot {
  struct Part {
    bool turns = true;
    Vector3 xyz, rpy;
    double mass = 0;
    Vector3 com;
    math::Symmetric3<double> moments;  // about the centre of mass, with axes of the link
  };
  std::vector<Part> parts;
};

class Writer {
 public:
  explicit Writer(unsigned seed) : random_(seed) {}

  Robot robot() {
    Robot robot;
    for (int i = 0, n = 1 + static_cast<int>(random_() % 5); i < n; ++i) {
      Robot::Part part;
      part.turns = coin(0.7);
      part.xyz = vector(0.5), part.rpy = vector(3), part.com = vector(0.2);
      part.mass = number(0.5, 3);
      const double x = number(0.1, 0.3), y = number(0.1, 0.3), z = number(0.1, 0.3);
      part.moments = {part.mass * (y * y + z * z), 0, 0,
                      part.mass * (x * x + z * z), 0, part.mass * (x * x + y * y)};
      robot.parts.push_back(part);
    }
    return robot;
  }

  static std::string as_urdf(const Robot& robot) {
    std::string out = "<link name=\"l0\"/>\n";
    const auto attribute = [](const Vector3& v) {
      return text(v.x) + " " + text(v.y) + " " + text(v.z);
    };
    for (std::size_t i = 0; i < robot.parts.size(); ++i) {
      const Robot::Part& p = robot.parts[i];
      const auto& I = p.moments;
      out += fmt::format(
          "<link name=\"l{0}\"><inertial><origin xyz=\"{1}\"/><mass value=\"{2}\"/><inertia "
          "ixx=\"{3}\" ixy=\"0\" ixz=\"0\" iyy=\"{4}\" iyz=\"0\" izz=\"{5}\"/></inertial></link>\n"
          "<joint name=\"j{0}\" type=\"{6}\"><parent link=\"l{7}\"/><child link=\"l{0}\"/>"
          "<origin xyz=\"{8}\" rpy=\"{9}\"/><axis xyz=\"0 0 1\"/>"
          "<limit effort=\"1\" velocity=\"1\"/></joint>\n",
          i + 1, attribute(p.com), text(p.mass), text(I.xx), text(I.yy), text(I.zz),
          p.turns ? "revolute" : "prismatic", i, attribute(p.xyz), attribute(p.rpy));
    }
    return out;
  }

  std::string as_turtle(const Robot& robot) {
    out_ = link("l0", {"m1"});
    for (std::size_t i = 0; i < robot.parts.size(); ++i) {
      const Robot::Part& p = robot.parts[i];
      const std::string n = std::to_string(i + 1), name = "l" + n;
      std::vector<std::string> frames = {"i" + n};
      if (i + 1 < robot.parts.size()) frames.push_back("m" + std::to_string(i + 2));
      out_ += link(name, frames);
      place("m" + n, "l" + std::to_string(i) + "-root",
            {rotation_from_rpy(p.rpy.x, p.rpy.y, p.rpy.z), p.xyz});
      add_joint(n, p.turns);
      add_inertia(n, p);
    }
    return out_;
  }

 private:
  double number(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  Vector3 vector(double size) {
    return {number(-size, size), number(-size, size), number(-size, size)};
  }
  bool coin(double chance = 0.5) { return number(0, 1) < chance; }
  std::string fresh(const std::string& stem) { return stem + std::to_string(++count_); }

  // The pose of a frame in another one, over frames in between.
  void place(const std::string& of, const std::string& wrt, const Pose& pose) {
    std::string from = wrt;
    Pose rest = pose;
    while (coin(0.4)) {
      const std::string between = fresh("f");
      out_ += ":" + between + " a geom:Frame ; geom:origin :" + between + "-origin .\n";
      const Vector3 a = vector(3);
      const Pose step = {rotation_from_rpy(a.x, a.y, a.z), vector(0.5)};
      state(between, from, step);
      rest = math::compose(math::invert(step), rest);
      from = between;
    }
    state(of, from, rest);
  }

  void state(std::string of, std::string wrt, Pose pose) {
    if (coin(0.4)) {
      std::swap(of, wrt);
      pose = math::invert(pose);
    }
    const Matrix3& R = pose.R;
    const std::string cosines = " coord:direction-cosine-x " + list({R.xx, R.yx, R.zx}) +
                                " ; coord:direction-cosine-y " + list({R.xy, R.yy, R.zy}) +
                                " ; coord:direction-cosine-z " + list({R.xz, R.yz, R.zz});
    const std::string id = fresh("p");
    const std::string relation = " ; rel:of :" + of + " ; rel:with-respect-to :" + wrt + " .\n";
    if (coin(0.7)) {
      out_ += ":" + id + " a rel:Pose" + relation + ":" + id +
              "-c a coord:PoseCoordinate ; coord:of-pose :" + id + " ; coord:as-seen-by :" + wrt +
              " ; qudt:unit unit:UNITLESS ;" + cosines + measured(pose.p);
      return;
    }
    out_ += ":" + id + " a rel:Orientation" + relation + ":" + id +
            "-c a coord:OrientationCoordinate ; coord:of-orientation :" + id +
            " ; coord:as-seen-by :" + wrt + " ; qudt:unit unit:UNITLESS ;" + cosines + " .\n";
    position(of + "-origin", wrt + "-origin", wrt, of, pose);
  }

  // Of a point at pose.p of frame `frame`, seen from it or from the other frame, either way.
  void position(std::string of, std::string wrt, const std::string& frame, const std::string& other,
                const Pose& pose) {
    const bool from_other = coin(0.3);
    Vector3 p = from_other ? transpose(pose.R) * pose.p : pose.p;
    if (coin(0.3)) {
      std::swap(of, wrt);
      p = -p;
    }
    const std::string id = fresh("x");
    out_ += ":" + id + " a rel:Position ; rel:of :" + of + " ; rel:with-respect-to :" + wrt +
            " .\n:" + id + "-c a coord:PositionCoordinate ; coord:of-position :" + id +
            " ; coord:as-seen-by :" + (from_other ? other : frame) + measured(p);
  }

  std::string measured(const Vector3& p) {
    const LengthUnit& unit = kLengths[random_() % std::size(kLengths)];
    return std::string(" ; qudt:unit unit:") + unit.name + " ; coord:x " + text(p.x / unit.metres) +
           " ; coord:y " + text(p.y / unit.metres) + " ; coord:z " + text(p.z / unit.metres) +
           " .\n";
  }

  void add_joint(const std::string& n, bool turns) {
    const std::string parent = "m" + n, child = "l" + n + "-root";
    std::string attachments = coin() ? ":" + parent + ", :" + child : ":" + child + ", :" + parent;
    out_ += ":j" + n + " a kc:Joint, " + (turns ? "kc:RevoluteJoint" : "skc:PrismaticJoint") +
            " ; kc:between-attachments " + attachments + " ; kc:common-axis :a" + n +
            " ; kc:origin-offset :o" + n + " .\n:o" + n + " a rel:Position ; rel:of :" + child +
            "-origin ; rel:with-respect-to :" + parent + "-origin .\n:a" + n +
            " a rel:LineCollinearity ; rel:lines ";
    if (coin()) {
      out_ += ":" + parent + "-z, :" + child + "-z .\n";
      return;
    }
    // The axis points the other way, and so does the joint.
    out_ +=
        ":" + parent + "-b, :" + child + "-b .\n:j" + n + " kc:polarity skc:NegativePolarity .\n";
    for (const std::string& frame : {parent, child}) {
      out_ += ":" + frame +
              "-d a coord:DirectionCoordinate ; "
              "<https://w3id.org/sinew/geometry#of-direction> :" +
              frame + "-b ; coord:as-seen-by :" + frame +
              " ; qudt:unit unit:UNITLESS ; coord:x 0 ; coord:y 0 ; coord:z -1 .\n";
    }
  }

  void add_inertia(const std::string& n, const Robot::Part& part) {
    const std::string root = "l" + n + "-root", frame = "i" + n;
    const Vector3 a = vector(3);
    const Pose X = {rotation_from_rpy(a.x, a.y, a.z), coin() ? part.com : vector(0.2)};
    place(frame, root, X);
    const RigidBodyInertia central = {part.mass, {0, 0, 0}, part.moments};
    // About a point of the link, with axes of the inertia's frame.
    std::string about = frame + "-origin";
    Vector3 point = X.p;
    if (coin(0.3)) {
      about = root + "-origin";
      point = {0, 0, 0};
    } else if (coin()) {
      about = "c" + n;
      point = part.com;
      out_ += ":l" + n + " geom:simplices :c" + n + " .\n";
      position(about, root + "-origin", root, frame, {X.R, part.com});
    }
    const Matrix3 back = transpose(X.R);
    const RigidBodyInertia I = transformed(central, back, back * (part.com - point));
    const bool grams = coin(), centimetres = coin();
    const double m = grams ? 1e-3 : 1, s = centimetres ? 1e-4 : 1;
    const auto& S = I.rotational;
    out_ += fmt::format(
        ":r{0} a dyn:RigidBodyInertia ; dyn:of-body :l{0} ; dyn:about :{1} .\n"
        ":r{0}-c a dync:RigidBodyInertiaCoordinate ; dync:of-inertia :r{0} ; dync:as-seen-by :{2} "
        "; qudt:unit unit:{3}, unit:M-KiloGM, unit:{4} ; dync:mass {5} ; "
        "dync:first-moment-of-mass {6} ; dync:ixx {7} ; dync:ixy {8} ; dync:ixz {9} ; dync:iyy "
        "{10} ; dync:iyz {11} ; dync:izz {12} .\n",
        n, about, frame, grams ? "GM" : "KiloGM", centimetres ? "KiloGM-CentiM2" : "KiloGM-M2",
        text(part.mass / m), list(I.first_moment), text(S.xx / s), text(S.xy / s), text(S.xz / s),
        text(S.yy / s), text(S.yz / s), text(S.zz / s));
  }

  std::mt19937 random_;
  std::string out_;
  int count_ = 0;
};

TEST(RandomModels, MoveAsTheSameRobotsDoInUrdf) {
  NormaliseOptions options;
  options.gravity = Vector3{0.3, -2, -9.5};
  for (unsigned seed = 0; seed < 60; ++seed) {
    Writer writer(seed);
    const Robot robot = writer.robot();
    Model linked, plain;
    options.base = "l0-root";
    const std::string model = writer.as_turtle(robot);
    normalise_texts(linked, {turtle(model)}, options);
    options.base = "l0";
    normalise_texts(plain, {urdf(Writer::as_urdf(robot))}, options);
    ASSERT_FALSE(linked.report.has_errors()) << seed << linked.problems() << model;
    ASSERT_FALSE(plain.report.has_errors()) << seed << plain.problems();
    const std::size_t n = robot.parts.size();
    ASSERT_EQ(linked.tree.joints.size(), n);
    ASSERT_EQ(plain.tree.joints.size(), n);
    Motion motion;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-2, 2);
    for (auto* numbers : {&motion.q, &motion.qd, &motion.qdd}) {
      numbers->resize(n);
      for (double& x : *numbers) x = any(random);
    }
    const Dynamics a = newton_euler(linked.tree, motion), b = newton_euler(plain.tree, motion);
    double largest = 1;
    for (const double force : b.forces) largest = std::max(largest, std::abs(force));
    for (std::size_t j = 0; j < n; ++j) {
      EXPECT_NEAR(a.forces[j], b.forces[j], 1e-11 * largest) << seed << " joint " << j << model;
    }
  }
}

}  // namespace
}  // namespace sinew::model::test
