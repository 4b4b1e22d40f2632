// A URDF file as plain data, each element with its line. Numbers keep full double precision, and
// the order is that of the file.
//
// Read here rather than by urdfdom, which keeps neither lines nor order, turns angles into
// quaternions, and says what is wrong on a log instead of to its caller; the tests compare with it.
// See docs/decisions/0005-urdf-reader.md.
//
// Limits: kMaximumUrdfBytes; nesting as tinyxml2's (500). Beyond them, an error.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sinew/base/error.h"

namespace sinew::model::urdf {

constexpr std::size_t kMaximumUrdfBytes = std::size_t{64} << 20;

using Numbers3 = std::array<double, 3>;

struct Origin {
  Numbers3 xyz = {0, 0, 0};  // m
  Numbers3 rpy = {0, 0, 0};  // rad, about fixed axes x, y, z in this order
};

struct Inertial {
  std::size_t line = 0;
  Origin origin;
  double mass = 0;                                              // kg
  double ixx = 0, ixy = 0, ixz = 0, iyy = 0, iyz = 0, izz = 0;  // kg m^2, about the origin
};

struct Box {
  Numbers3 size;  // m
};
struct Cylinder {
  double radius = 0, length = 0;  // m
};
struct Sphere {
  double radius = 0;  // m
};
struct Mesh {
  std::string file;
  Numbers3 scale = {1, 1, 1};
};

struct Shape {
  std::size_t line = 0;
  bool visual = true;  // else for collision
  Origin origin;
  std::variant<Box, Cylinder, Sphere, Mesh> geometry;
};

struct Link {
  std::size_t line = 0;
  std::string name;
  std::optional<Inertial> inertial;
  std::vector<Shape> shapes;
};

enum class JointType { kFixed, kRevolute, kContinuous, kPrismatic, kPlanar, kFloating };

struct Limit {
  std::optional<double> lower, upper, effort, velocity;
};

struct Dynamics {
  std::optional<double> damping, friction;
};

struct Mimic {
  std::string joint;
  double multiplier = 1, offset = 0;
};

struct Joint {
  std::size_t line = 0;
  std::string name;
  JointType type = JointType::kFixed;
  std::string parent, child;  // links
  Origin origin;
  Numbers3 axis = {1, 0, 0};  // as written, not made a unit vector; of a planar joint the normal
  std::optional<Limit> limit;
  Dynamics dynamics;
  std::optional<Mimic> mimic;
};

struct Document {
  std::string file;
  std::string robot;
  std::size_t line = 0;
  std::vector<Link> links;
  std::vector<Joint> joints;
};

// Reads a document and checks that its links and joints form one tree. What is left out (materials,
// simulator settings, transmissions) is a warning; what is unknown is an error, or with `lenient` a
// warning.
Document read(std::string_view text, const std::string& file, bool lenient, Report& report);

// The tree's part of that: names that are used twice or not at all, loops, several roots.
void check_tree(const Document& document, Report& report);

}  // namespace sinew::model::urdf
