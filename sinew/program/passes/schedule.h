// The order in which to compute the nodes, so that few values are live at once: processors have 16
// or 32 registers, and every value beyond costs a store and a load. Fills Computation::order.
#pragma once

#include <cstdint>

#include "sinew/program/dag/dag.h"

namespace sinew::program {

// As long as fewer values than this are live, what the longest path waits for comes first; beyond,
// what frees values.
inline constexpr std::uint32_t kLiveLimit = 24;

// A list schedule with that limit, or the order of the nodes where it keeps more values live than
// that.
Computation schedule(Computation computation);

// The largest number of values (without constants and inputs, which need no register of their own)
// that are live at once in the computation's order.
std::uint32_t live_values(const Computation& computation);

}  // namespace sinew::program
