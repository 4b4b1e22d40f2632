#include "sinew/program/snap_constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace sinew::program {
namespace {

// What the numbers of a layout are, as far as their sizes can be compared.
enum Kind : std::uint8_t {
  kCosine,
  kLength,
  kMass,
  kFirstMoment,
  kSecondMoment,
  kAngular,
  kLinear
};

constexpr std::array<Kind, 12> kPose = {kCosine, kCosine, kCosine, kLength, kCosine, kCosine,
                                        kCosine, kLength, kCosine, kCosine, kCosine, kLength};
constexpr std::array<Kind, 10> kInertia = {
    kMass,         kFirstMoment,  kFirstMoment,  kFirstMoment,  kSecondMoment,
    kSecondMoment, kSecondMoment, kSecondMoment, kSecondMoment, kSecondMoment};
constexpr std::array<Kind, 6> kTwist = {kAngular, kAngular, kAngular, kLinear, kLinear, kLinear};

// The kinds of a variable's numbers; empty where nothing is known about them.
std::span<const Kind> kinds_of(const Variable& v) {
  if (v.role != Role::kConstant) return {};
  if (v.quantity == "pose" && v.size == kPose.size()) return kPose;
  if (v.quantity == "rigid-body-inertia" && v.size == kInertia.size()) return kInertia;
  const bool twist = v.quantity == "velocity-twist" || v.quantity == "acceleration-twist";
  if (twist && v.size == kTwist.size()) return kTwist;
  return {};
}

// What lengths are measured by: a metre, or the longest if that is less. Centres of mass and radii
// of gyration count, for robots whose joints are in one place.
double length_of(const Program& program) {
  double longest = 0;
  for (const Variable& v : program.variables) {
    const std::span<const Kind> kinds = kinds_of(v);
    const double mass = !kinds.empty() && kinds[0] == kMass ? v.value[0] : 0;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const double size = std::abs(v.value[k]);
      if (kinds[k] == kLength) longest = std::max(longest, size);
      if (kinds[k] == kFirstMoment && mass > 0) longest = std::max(longest, size / mass);
      if (kinds[k] == kSecondMoment && mass > 0)
        longest = std::max(longest, std::sqrt(size / mass));
    }
  }
  return longest > 0 ? std::min(longest, 1.0) : 1.0;
}

// Below what size the numbers of each kind are nothing but round-off, in this variable.
std::array<double, kLinear + 1> dust_of(const Variable& v, std::span<const Kind> kinds,
                                        double length) {
  std::array<double, kLinear + 1> largest{};
  for (std::size_t k = 0; k < kinds.size(); ++k)
    largest[kinds[k]] = std::max(largest[kinds[k]], std::abs(v.value[k]));
  std::array<double, kLinear + 1> dust{};
  dust[kLength] = kLengthShare * length;
  dust[kFirstMoment] = dust[kLength] * largest[kMass];
  dust[kSecondMoment] = kInertiaShare * largest[kSecondMoment];
  dust[kAngular] = kTwistShare * largest[kAngular];
  dust[kLinear] = kTwistShare * largest[kLinear];
  return dust;
}

}  // namespace

std::vector<SnappedConstant> snap_constants(Program& program) {
  const double length = length_of(program);
  std::vector<SnappedConstant> snapped;
  for (std::uint32_t i = 0; i < program.variables.size(); ++i) {
    Variable& v = program.variables[i];
    const std::span<const Kind> kinds = kinds_of(v);
    const std::array<double, kLinear + 1> dust = dust_of(v, kinds, length);
    for (std::uint32_t k = 0; k < kinds.size(); ++k) {
      const double from = v.value[k];
      double to = from;
      if (kinds[k] == kCosine) {
        for (const double exact : {-1.0, 0.0, 1.0}) {
          if (std::abs(from - exact) <= kRotationTolerance) to = exact;
        }
      } else if (std::abs(from) <= dust[kinds[k]]) {
        to = 0.0;
      }
      if (to == from) continue;
      v.value[k] = to;
      snapped.push_back({i, k, from, to});
    }
  }
  return snapped;
}

}  // namespace sinew::program
