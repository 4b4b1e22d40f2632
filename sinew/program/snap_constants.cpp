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

double share_of(Kind kind) {
  if (kind == kLength) return kLengthShare;
  return kind == kAngular || kind == kLinear ? kTwistShare : kInertiaShare;
}

}  // namespace

std::vector<SnappedConstant> snap_constants(Program& program) {
  std::array<double, kLinear + 1> largest{};  // of each kind in the whole program
  for (const Variable& v : program.variables) {
    const std::span<const Kind> kinds = kinds_of(v);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      largest[kinds[k]] = std::max(largest[kinds[k]], std::abs(v.value[k]));
    }
  }

  std::vector<SnappedConstant> snapped;
  for (std::uint32_t i = 0; i < program.variables.size(); ++i) {
    Variable& v = program.variables[i];
    const std::span<const Kind> kinds = kinds_of(v);
    std::array<double, kLinear + 1> own = largest;
    if (!kinds.empty() && kinds[0] == kAngular) {
      own[kAngular] = own[kLinear] = 0.0;
      for (std::size_t k = 0; k < kinds.size(); ++k) {
        own[kinds[k]] = std::max(own[kinds[k]], std::abs(v.value[k]));
      }
    }
    for (std::uint32_t k = 0; k < kinds.size(); ++k) {
      const double from = v.value[k];
      double to = from;
      if (kinds[k] == kCosine) {
        for (const double exact : {-1.0, 0.0, 1.0}) {
          if (std::abs(from - exact) <= kRotationTolerance) to = exact;
        }
      } else if (std::abs(from) <= share_of(kinds[k]) * own[kinds[k]]) {
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
