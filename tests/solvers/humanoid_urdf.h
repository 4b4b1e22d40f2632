// A humanoid of 30 joints that nobody built: legs of 6, arms of 7, a torso of 3 and a neck. With
// its floating base it has 36 degrees of freedom, as the largest robots that people compare solvers
// on.
#pragma once

#include <cstdint>
#include <string>

namespace sinew::test {

// Proportions and masses of a tall person, drawn anew within a fifth for each seed: every origin
// and every inertia is a number of its own, the right side mirrors the left one. The same seed
// gives the same text.
std::string humanoid_urdf(std::uint32_t seed = 1);

inline constexpr unsigned kHumanoidJoints = 30;

}  // namespace sinew::test
