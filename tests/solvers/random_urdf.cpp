#include "random_urdf.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace sinew::test {
namespace {

class Generator {
 public:
  explicit Generator(const RandomRobot& robot) : robot_(robot), random_(robot.seed) {}

  std::string urdf() {
    std::string text =
        "<?xml version=\"1.0\"?>\n<robot name=\"random\">\n" + link(0, robot_.floating);
    unsigned links = 1;
    unsigned last = 0;
    for (unsigned joint = 0; joint < robot_.joints; ++joint) {
      while (chance(robot_.fixed / (1 + robot_.fixed))) {
        const std::string fixed = fixed_joint(parent(last, links), links);
        text += link(links, true) + fixed;
        last = links++;
      }
      const std::string moving = moving_joint(joint, parent(last, links), links);
      text += link(links, true) + moving;
      last = links++;
    }
    return text + "</robot>\n";
  }

 private:
  double number(double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random_);
  }
  bool chance(double probability) { return number(0, 1) < probability; }
  unsigned parent(unsigned last, unsigned links) {
    if (!chance(robot_.branching)) return last;
    return std::uniform_int_distribution<unsigned>(0, links - 1)(random_);
  }
  std::array<double, 3> unit_vector() {
    for (;;) {
      const std::array<double, 3> v{number(-1, 1), number(-1, 1), number(-1, 1)};
      const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      if (length > 0.1 && length < 1) return {v[0] / length, v[1] / length, v[2] / length};
    }
  }
  // Now and then a straight one, as real robots have them.
  std::array<double, 3> axis() {
    if (chance(0.5)) return unit_vector();
    std::array<double, 3> v{0, 0, 0};
    v[std::uniform_int_distribution<std::size_t>(0, 2)(random_)] = chance(0.5) ? 1 : -1;
    return v;
  }
  std::string origin() {
    const auto angle = [&] {
      return chance(0.4) ? M_PI_2 * std::round(number(-2, 2)) : number(-3, 3);
    };
    const auto length = [&] { return chance(0.3) ? 0.0 : number(-0.4, 0.4); };
    // One after the other: arguments of a call are evaluated in the compiler's own order.
    const double yaw = angle(), pitch = angle(), roll = angle();
    const double z = length(), y = length(), x = length();
    return fmt::format("<origin xyz=\"{} {} {}\" rpy=\"{} {} {}\"/>", x, y, z, roll, pitch, yaw);
  }
  std::string link(unsigned index, bool heavy) {
    if (!heavy) return fmt::format("  <link name=\"link{}\"/>\n", index);
    // A box has an inertia that exists.
    const double mass = number(0.2, 5), x = number(0.05, 0.3), y = number(0.05, 0.3),
                 z = number(0.05, 0.3);
    return fmt::format(
        "  <link name=\"link{}\"><inertial>{}<mass value=\"{}\"/><inertia ixx=\"{}\" iyy=\"{}\" "
        "izz=\"{}\" "
        "ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n",
        index, origin(), mass, mass * (y * y + z * z) / 12, mass * (x * x + z * z) / 12,
        mass * (x * x + y * y) / 12);
  }
  static std::string ends(unsigned parent, unsigned child) {
    return fmt::format("<parent link=\"link{}\"/><child link=\"link{}\"/>", parent, child);
  }
  std::string fixed_joint(unsigned parent, unsigned child) {
    return fmt::format("  <joint name=\"fixed{}\" type=\"fixed\">{}{}</joint>\n", child,
                       ends(parent, child), origin());
  }
  std::string moving_joint(unsigned index, unsigned parent, unsigned child) {
    const auto a = axis();
    const char* type = chance(robot_.prismatic) ? "prismatic"
                       : chance(0.5)            ? "continuous"
                                                : "revolute";
    const bool limited = std::string_view(type) != "continuous";
    return fmt::format(
        "  <joint name=\"joint{}\" type=\"{}\">{}{}<axis xyz=\"{} {} {}\"/>{}</joint>\n", index,
        type, ends(parent, child), origin(), a[0], a[1], a[2],
        limited ? "<limit lower=\"-2\" upper=\"2\" effort=\"100\" velocity=\"5\"/>" : "");
  }

  RandomRobot robot_;
  std::mt19937 random_;
};

}  // namespace

std::string random_urdf(const RandomRobot& robot) { return Generator(robot).urdf(); }

}  // namespace sinew::test
