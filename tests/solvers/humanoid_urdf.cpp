#include "humanoid_urdf.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <random>
#include <string_view>
#include <vector>

namespace sinew::test {
namespace {

using Vector = std::array<double, 3>;

enum class Axis { kX, kY, kZ };

// A link with the joint in front of it, of the left side where there are two. x is forward, y to
// the left, z up.
struct Part {
  std::string_view name, parent;
  Axis axis;
  Vector origin;  // of the joint, seen from the parent [m]
  double roll;    // of the joint's frame about x [rad]: shoulders slope
  double mass;    // [kg]
  Vector size;    // of the box that the mass fills [m]
  Vector centre;  // of the box [m]
  double lower, upper;
};

const Part kTrunk[] = {
    {"waist", "pelvis", Axis::kZ, {-0.01, 0, 0.11}, 0, 2.6, {.12, .14, .09}, {0, 0, .05}, -1, 1},
    {"abdomen", "waist", Axis::kY, {.005, 0, .09}, 0, 3.4, {.13, .16, .1}, {.01, 0, .04}, -.3, .7},
    {"chest", "abdomen", Axis::kX, {.01, 0, .06}, 0, 24, {.24, .34, .4}, {-.03, 0, .2}, -.5, .5},
    {"head", "chest", Axis::kY, {.02, 0, .47}, 0, 3.9, {.19, .16, .24}, {.03, 0, .1}, -.6, 1.1},
};

const Part kLeg[] = {
    {"hip", "pelvis", Axis::kZ, {-.012, .1, -.03}, 0, 1.9, {.1, .1, .08}, {.02, .01, -.01}, -1, .3},
    {"groin", "hip", Axis::kX, {.01, .02, -.04}, 0, 2.2, {.14, .1, .1}, {.02, -.01, 0}, -.5, .5},
    {"thigh", "groin", Axis::kY, {.04, .01, -.05}, 0, 7.7, {.15, .14, .4}, {0, .01, -.2}, -1.6, .7},
    {"shin", "thigh", Axis::kY, {-.03, .005, -.4}, 0, 4.4, {.1, .1, .4}, {.01, 0, -.18}, 0, 2.3},
    {"ankle", "shin", Axis::kY, {.01, 0, -.41}, 0, .5, {.05, .06, .05}, {.001, 0, .002}, -1, .7},
    {"foot",
     "ankle",
     Axis::kX,
     {.005, .002, -.02},
     0,
     2.3,
     {.26, .12, .06},
     {.03, 0, -.05},
     -.5,
     .5},
};

const Part kArm[] = {
    {"scapula", "chest", Axis::kY, {.02, .19, .38}, .5, 3.1, {.12, .11, .12}, {0, .09, 0}, -2, 2},
    {"shoulder",
     "scapula",
     Axis::kX,
     {.01, .13, .01},
     0,
     2.9,
     {.1, .1, .11},
     {0, .03, -.02},
     -1.5,
     1.5},
    {"arm", "shoulder", Axis::kY, {.012, .15, .014}, 0, 3.6, {.09, .2, .1}, {0, .1, .01}, 0, 3},
    {"elbow", "arm", Axis::kX, {-.01, .13, .01}, 0, 2.5, {.08, .12, .09}, {.01, .04, 0}, 0, 2.3},
    {"forearm", "elbow", Axis::kY, {.008, .17, -.009}, 0, 1.9, {.08, .18, .07}, {0, .06, 0}, -3, 3},
    {"wrist", "forearm", Axis::kX, {.004, .12, .006}, 0, .6, {.05, .06, .05}, {0, .01, 0}, -1, 1},
    {"hand", "wrist", Axis::kZ, {.006, .04, .003}, 0, .8, {.05, .14, .09}, {.01, .08, 0}, -1, 1},
};

class Generator {
 public:
  explicit Generator(std::uint32_t seed) : random_(seed) {}

  std::string urdf() {
    std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"humanoid\">\n";
    text += link("pelvis",
                 drawn(Part{"", "", Axis::kZ, {}, 0, 9.3, {.2, .3, .2}, {.01, 0, .02}, 0, 0}), 1);
    for (const Part& part : kTrunk) text += joint_and_link(drawn(part), "", 1);
    for (const auto& limb : {std::vector<Part>(std::begin(kLeg), std::end(kLeg)),
                             std::vector<Part>(std::begin(kArm), std::end(kArm))}) {
      std::vector<Drawn> parts;
      for (const Part& part : limb) parts.push_back(drawn(part));
      for (const Drawn& part : parts) text += joint_and_link(part, "left_", 1);
      for (const Drawn& part : parts) text += joint_and_link(part, "right_", -1);
    }
    return text + "</robot>\n";
  }

 private:
  struct Drawn {
    Part part;
    Vector tilt;  // of the box [rad]
  };

  // Within a fifth of a number.
  double near(double x) { return x * std::uniform_real_distribution<>(0.8, 1.2)(random_); }

  Drawn drawn(Part part) {
    part.mass = near(part.mass);
    part.roll = near(part.roll);
    for (Vector* v : {&part.origin, &part.size, &part.centre}) {
      for (double& x : *v) x = near(x);
    }
    Drawn result{part, {}};
    for (double& angle : result.tilt) {
      angle = std::uniform_real_distribution<>(-0.1, 0.1)(random_);
    }
    return result;
  }

  static std::string link(const std::string& name, const Drawn& drawn, double side) {
    const Part& p = drawn.part;
    const double yy = p.size[0] * p.size[0], xx = p.size[1] * p.size[1], zz = p.size[2] * p.size[2];
    // A box about its centre; its axes are tilted against those of the link.
    return fmt::format(
        "<link name=\"{}\"><inertial><origin xyz=\"{} {} {}\" rpy=\"{} {} {}\"/>"
        "<mass value=\"{}\"/><inertia ixx=\"{}\" ixy=\"0\" ixz=\"0\" iyy=\"{}\" iyz=\"0\" "
        "izz=\"{}\"/></inertial></link>\n",
        name, p.centre[0], side * p.centre[1], p.centre[2], side * drawn.tilt[0], drawn.tilt[1],
        side * drawn.tilt[2], p.mass, p.mass / 12 * (xx + zz), p.mass / 12 * (yy + zz),
        p.mass / 12 * (xx + yy));
  }

  static std::string joint_and_link(const Drawn& drawn, const std::string& prefix, double side) {
    const Part& p = drawn.part;
    const std::string name = prefix + std::string(p.name);
    const bool from_trunk = p.parent == "pelvis" || p.parent == "chest" || prefix.empty();
    const std::string parent = (from_trunk ? "" : prefix) + std::string(p.parent);
    // Mirrored: rotations about x and z turn round, those about y do not.
    const char* axis = p.axis == Axis::kX   ? (side < 0 ? "-1 0 0" : "1 0 0")
                       : p.axis == Axis::kY ? "0 1 0"
                                            : (side < 0 ? "0 0 -1" : "0 0 1");
    return link(name, drawn, side) +
           fmt::format(
               "<joint name=\"{0}_joint\" type=\"revolute\"><parent link=\"{1}\"/>"
               "<child link=\"{0}\"/><origin xyz=\"{2} {3} {4}\" rpy=\"{5} 0 0\"/>"
               "<axis xyz=\"{6}\"/><limit lower=\"{7}\" upper=\"{8}\" effort=\"300\" "
               "velocity=\"12\"/></joint>\n",
               name, parent, p.origin[0], side * p.origin[1], p.origin[2], side * p.roll, axis,
               p.lower, p.upper);
  }

  std::mt19937 random_;
};

}  // namespace

std::string humanoid_urdf(std::uint32_t seed) { return Generator(seed).urdf(); }

}  // namespace sinew::test
