// Which values of a long straight-line function are in registers, step by step.
//
// Dynamics of an arm have three times as many values alive as a processor has registers. LLVM's
// allocators, which look at one value after the other, spend a third of the code on writing values
// to the stack and fetching them; for straight-line code one knows when each value is read next,
// and the best choice is to let that one go which is read again last (Belady 1966), or something
// that lies in memory anyway and is not needed soon.
// What goes is written to an array when it is computed, and fetched for its next reader.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/backend/value_steps.h"

namespace sinew::backend {

struct RegisterPlan {
  std::vector<std::uint32_t> slot;  // of a computed value: its place in the array, if it goes there
  std::vector<std::vector<std::uint32_t>> leaving;  // after each step: what is in no register now
  std::uint32_t size = 0;                           // numbers in the array
};

// `registers`: values held at a time. What lies in memory anyway is held only from one reader to
// the next one that is no more than `longest` steps away.
RegisterPlan plan_registers(const ValueSteps& steps, std::uint32_t registers,
                            std::uint32_t longest);

}  // namespace sinew::backend
