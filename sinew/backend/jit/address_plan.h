// Registers that bring scattered numbers of an array within reach of short addresses.
//
// An instruction names what lies within 128 bytes of a register with one byte, all else with four.
// The results of a mass matrix of 36 x 36 lie up to 10 KB apart. With a second register, which
// costs a byte, an address is base + 1, 2, 4 or 8 times the index: two bases and two indices, set
// once, are in the middle of 18 windows. Where rows lie the index apart, as in a matrix, those are
// the rows 1, 2, 4 and 8.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::backend {

// All in numbers.
struct AddressPlan {
  std::vector<std::int32_t> bases;    // places in the array, at least one
  std::vector<std::int32_t> indices;  // distances
};

struct PlannedAddress {
  std::uint32_t base = 0;
  std::uint32_t index = 0;
  std::uint32_t scale = 0;    // 0: without an index
  std::int32_t distance = 0;  // what is left to the number
};

// `places`: of the numbers in the array, one entry for each instruction that names one. `near`: so
// many of them lie to either side of a register. No more than `registers`, and each of them saves
// more than it costs to set.
AddressPlan plan_addresses(std::span<const std::uint32_t> places, std::int32_t near,
                           std::size_t registers);

// The shortest; what nothing brings near is as far as it is from the first base.
PlannedAddress address_of(const AddressPlan& plan, std::int32_t near, std::uint32_t place);

}  // namespace sinew::backend
