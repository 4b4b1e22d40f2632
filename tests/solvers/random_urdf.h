// Robots that nobody drew: trees of any branching with joints of any kind and axis, as URDF.
#pragma once

#include <cstdint>
#include <string>

namespace sinew::test {

struct RandomRobot {
  unsigned joints = 10;  // moving ones
  double branching =
      0.4;  // probability that a link is attached to an earlier one instead of the last
  double prismatic = 0.25;  // share of prismatic joints
  double fixed = 0.2;       // further joints that are fixed, as a share of the moving ones
  bool floating = false;    // the first link has mass
  std::uint32_t seed = 1;
};

// Physically plausible inertias, any origin, unit axes. The same seed gives the same text.
std::string random_urdf(const RandomRobot& robot);

}  // namespace sinew::test
