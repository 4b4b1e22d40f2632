// How large and how small the numbers of a model may be. Solvers multiply and divide them: masses
// with squares of lengths, those with accelerations, ratios with ratios. Within these sizes (SI
// units) no such product overflows; beyond them lies no machine, but a slip of the unit or of the
// exponent, which is reported where it stands. (That a body of 1e12 kg next to one of 1e-30 kg
// leaves no digits of the smaller one is another matter.)
//
// Limits of joint positions, velocities and forces are only ever compared: they must be finite, and
// may be as large as a double can say (which is how some files write "none").
#pragma once

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/model/structure.h"

namespace sinew::model {

constexpr double kLargestMass = 1e12;                                    // kg
constexpr double kLargestLength = 1e12;                                  // m
constexpr double kLargestFirstMoment = kLargestMass * kLargestLength;    // kg m
constexpr double kLargestMoment = kLargestFirstMoment * kLargestLength;  // kg m^2
constexpr double kLargestAcceleration = 1e12;                            // m/s^2 or rad/s^2
constexpr double kLargestRatio = 1e12;  // of joints that follow others; also a pitch [m/rad]

// What a force divides by; zero itself is a body without mass, or a point.
constexpr double kSmallestMass = 1e-30;    // kg: an electron's
constexpr double kSmallestMoment = 1e-48;  // kg m^2: of that mass at a nanometre

// Whether it is a number between -largest and largest.
bool within(double number, double largest);
bool within(const Vector3& numbers, double largest);

// What is wrong with the sizes of an inertia's numbers, or nothing.
std::string fault_of_size(const RigidBodyInertia& I);

// Masses, inertias, poses, positions, pitches, ratios of followers, limits, the base's
// acceleration.
void check_sizes(const Structure& structure, const graph::Terms& terms, const graph::Places& places,
                 Report& report);

}  // namespace sinew::model
