// Reference evaluation of a data-flow graph, node by node, and the number of operations it takes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sinew/program/dag/dag.h"

namespace sinew::program {

// The results for these inputs (precondition: as many as computation.inputs).
std::vector<double> evaluate(const Computation& computation, std::span<const double> inputs);

// Floating-point operations of one evaluation. A fused multiply-add counts as one of each, sine and
// cosine of the same angle as one sincos; signs are free.
struct OperationCount {
  std::uint32_t add = 0;
  std::uint32_t multiply = 0;
  std::uint32_t divide = 0;
  std::uint32_t sqrt = 0;
  std::uint32_t sincos = 0;
  std::uint32_t select = 0;

  bool operator==(const OperationCount&) const = default;
};

// Only what the results need is counted.
OperationCount count_operations(const Computation& computation);

// For each node, 1 if some result needs it, else 0.
std::vector<std::uint8_t> live_nodes(const Computation& computation);

}  // namespace sinew::program
