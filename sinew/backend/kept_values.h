// Which values of a long straight-line function wait in memory until they are used again.
//
// Dynamics of an arm have three times as many values alive as a processor has registers. A compiler
// that has to find room spends a fifth of the code on moving values about, so we choose: whenever
// there are more than `registers`, the value that is read again last makes room (Belady 1966). It
// is written to an array when it is computed, and all later reads are memory operands. Internal to
// `backend`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sinew/backend/value_steps.h"

namespace sinew::backend {

// Processors have 16 registers or, with AVX-512, 32, of which the compiler needs some itself.
inline constexpr std::uint32_t kKeptRegisters = 30;

// Nodes in a stage: within it, what is read from memory may stay in a register, and no longer.
inline constexpr std::uint32_t kStage = 40;

// Neighbours in memory that an instruction reaches with a displacement of one byte to either side
// of a pointer, without AVX-512's scaling: half of them, in numbers of eight bytes.
inline constexpr std::uint32_t kNearNumbers = 16;

// Pointers into the array: more would leave too few registers for other addresses (five, of the
// fourteen that gcc has where arrays are aligned).
inline constexpr std::uint32_t kKeptPointers = 9;

struct KeptValues {
  std::vector<std::uint32_t> slot;  // of a value: its place in the array; kNoSlot: never there
  std::uint32_t size = 0;           // numbers in the array

  bool any() const { return size > 0; }
  // What is read from memory from after this step on.
  std::span<const std::uint32_t> leaving(std::size_t step) const {
    const std::uint32_t begin = step == 0 ? 0 : left_ends[step - 1];
    return std::span(left).subspan(begin, left_ends[step] - begin);
  }

  std::vector<std::uint32_t> left, left_ends;  // those of all steps, and where each step's end
};

// Where a slot lies from one of the pointers into the array: each reaches 2 * kNearNumbers of them
// with short addresses, and the last one all that are left.
struct KeptPlace {
  std::string pointer;  // "kept", "kept2", …
  int offset;
};

std::vector<std::string> kept_pointers(std::uint32_t size);
std::uint32_t kept_numbers(std::uint32_t size);  // of the array: no pointer leaves it
KeptPlace kept_place(std::uint32_t slot);

KeptValues keep_values(const ValueSteps& steps, std::uint32_t registers = kKeptRegisters);

}  // namespace sinew::backend
