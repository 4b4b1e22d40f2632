// What a data block can mean: how many numbers, in which SI units, and which frames it must name.
// The layouts are those of docs/architecture.md.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace sinew::algorithm {

// The symbols that give a quantity its meaning. For a pose they are frames: X_AB is the pose *of* B
// *with respect to* A. For motion and force, `of` and `wrt` are bodies, `seen_by` is the frame that
// gives the directions, and `reference` the frame whose origin is the point that the linear part
// (or the moment) is about; a body there stands for its centre of mass. For a joint's quantities,
// `of` and `wrt` are the same as in the twist or pose that they make.
enum class Attribute : std::uint8_t { kOf, kWrt, kReference, kSeenBy };
inline constexpr std::size_t kAttributes = 4;
std::string_view to_string(
    Attribute attribute);  // "of", "with-respect-to", "reference-point", "seen-by"

struct Quantity {
  std::string_view name;
  std::uint32_t size;     // numbers; 0: given by each data block
  std::string_view unit;  // SI, QUDT names, one for each group of numbers that shares a unit
  std::string_view unit_prismatic;  // for the joint quantities of a translational joint; else empty
  std::uint8_t attributes;          // those it must have: a bit for each Attribute
};

std::span<const Quantity> quantities();
const Quantity* find_quantity(std::string_view name);  // nullptr when there is none

constexpr bool needs(const Quantity& quantity, Attribute attribute) {
  return (quantity.attributes >> static_cast<unsigned>(attribute)) & 1u;
}

}  // namespace sinew::algorithm
