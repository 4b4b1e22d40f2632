// The sines and cosines of a block's angles, each a vector with one of each sample.
#pragma once

#include <llvm-c/Core.h>

#include <cstdint>
#include <vector>

#include "sinew/backend/jit/place.h"
#include "sinew/backend/jit/sincos.h"

namespace sinew::backend {

// What a call that may be made here gives back, so that it need be kept nowhere where it is not
// made.
struct BlockParameters {
  LLVMValueRef in = nullptr, out = nullptr, row_bytes = nullptr;
};

// Those of the inputs in `rows`, which ascend. A few angles are computed two or three at a time,
// operation by operation, and are in registers afterwards. Those of many are in memory, written by
// loops: a loop of fifty instructions takes the time of as many copies of it, for its iterations do
// not wait for each other.
bool sines_are_in_registers(const std::vector<std::uint32_t>& rows);

// `type`: a vector of numbers. `array`: for all sines, behind them all cosines, wherever they are
// wanted. Returns those that are in registers.
SincosValues emit_block_sines(const Place& place, LLVMTypeRef type,
                              const std::vector<std::uint32_t>& rows, LLVMValueRef array,
                              BlockParameters& parameters);

}  // namespace sinew::backend
