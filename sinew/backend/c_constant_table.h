// The constants of a long flat function of one sample, in a table behind a pointer: one whose
// address is in a register takes three bytes less than one that is addressed from the instruction.
// Internal to `backend`.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sinew/backend/c_parts.h"
#include "sinew/backend/kept_values.h"

namespace sinew::backend {

class ConstantTable {
 public:
  // Of the function NAME, whose name in upper case is `upper`; the table is NAME_`part`.
  ConstantTable(std::string name, std::string upper, std::string scalar, std::string part)
      : name_(std::move(name)),
        upper_(std::move(upper)),
        scalar_(std::move(scalar)),
        part_(std::move(part)) {}

  const std::string& part() const { return part_; }

  // Declares the pointer, `number`, and lets it reach what is placed next.
  void declare_pointer(CodeBlock& code);
  // Lets it reach that many numbers more. A vector begins at a multiple of its lanes.
  void make_room(std::size_t numbers, CodeBlock& code);
  // Places a constant, a number for each lane, and returns where it is from the pointer. Uses may
  // share it where it is among the last `shared` numbers: a compiler reads it into a register then,
  // by an instruction that is longer than the addresses in two of theirs.
  int place(std::span<const std::string> lanes, std::size_t shared = 0);
  // The table, after everything has been placed, aligned to vectors of so many lanes.
  void declare_table(unsigned lanes, CodeBlock& parts);

 private:
  // What the pointer reaches with the shortest addresses, half of it to either side.
  static constexpr std::size_t kReach = 2 * kNearNumbers;

  void move_pointer(CodeBlock& code);
  int from_pointer(std::size_t at) const {
    return static_cast<int>(at - begin_) - static_cast<int>(kNearNumbers);
  }

  std::string name_, upper_, scalar_, part_;
  std::vector<std::string> numbers_;
  std::size_t begin_ = 0;  // the first number that the pointer reaches
};

}  // namespace sinew::backend
