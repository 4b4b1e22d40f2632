#include "sinew/algorithm/quantities.h"

#include <algorithm>
#include <array>

namespace sinew::algorithm {
namespace {

constexpr std::uint8_t kNone = 0, kOf = 1, kOfWrt = 3, kOfSeen = 5, kAll = 7;

constexpr std::array kQuantities = {
    Quantity{"pose", 12, "UNITLESS M", "", kOfWrt},
    Quantity{"velocity-twist", 6, "RAD-PER-SEC M-PER-SEC", "", kAll},
    Quantity{"acceleration-twist", 6, "RAD-PER-SEC2 M-PER-SEC2", "", kAll},
    Quantity{"wrench", 6, "N-M N", "", kOfSeen},
    Quantity{"rigid-body-inertia", 10, "KiloGM KiloGM-M KiloGM-M2", "", kOfSeen},
    Quantity{"joint-position", 1, "RAD", "M", kAll},
    Quantity{"joint-velocity", 1, "RAD-PER-SEC", "M-PER-SEC", kAll},
    Quantity{"joint-acceleration", 1, "RAD-PER-SEC2", "M-PER-SEC2", kAll},
    Quantity{"joint-force", 1, "N-M", "N", kAll},
};

}  // namespace

std::string_view to_string(Attribute attribute) {
  constexpr std::array<std::string_view, kAttributes> names = {"of", "with-respect-to", "seen-by"};
  return names[static_cast<std::size_t>(attribute)];
}

std::span<const Quantity> quantities() { return kQuantities; }

const Quantity* find_quantity(std::string_view name) {
  const auto* found = std::find_if(kQuantities.begin(), kQuantities.end(),
                                   [&](const Quantity& quantity) { return quantity.name == name; });
  return found == kQuantities.end() ? nullptr : found;
}

}  // namespace sinew::algorithm
