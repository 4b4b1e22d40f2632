// Where a program's inputs, outputs and states lie in the arrays that its caller hands over: one
// after the other, in the order of the program's variables. Every back end uses the same offsets.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/program/program.h"

namespace sinew::program {

struct Slot {
  std::uint32_t variable = 0;  // index into Program::variables
  std::uint32_t offset = 0;    // of its first number
};

struct Interface {
  std::vector<Slot> inputs;
  std::vector<Slot> outputs;
  std::vector<Slot> states;
  std::uint32_t in_size = 0;  // numbers
  std::uint32_t out_size = 0;
  std::uint32_t state_size = 0;
};

Interface interface_of(const Program& program);

}  // namespace sinew::program
