// The passes over the scalar data-flow graph, in their order.
#pragma once

#include <functional>
#include <string_view>

#include "sinew/program/dag/dag.h"
#include "sinew/program/dag/evaluate.h"

namespace sinew::program {

// What a pass has done.
struct PassReport {
  std::string_view name;
  OperationCount before, after;
  std::uint32_t nodes_after = 0;
  std::uint32_t negations_before = 0, negations_after = 0;  // choose_signs.h
  double time_us = 0.0;
};

struct OptimiseOptions {
  std::function<void(const PassReport&)> trace;  // called after each pass; may be empty
  bool choose_signs = true;  // not where computations read from each other: limb_signs.h
};

// The same results (to round-off) with fewer operations, in a good order to compute them.
Computation optimise(Computation computation, const OptimiseOptions& options = {});

// One line of a trace: "factor sums: 190 + 219 -> 188 + 210 operations, 512 nodes, 35 us".
std::string to_string(const PassReport& report);

}  // namespace sinew::program
