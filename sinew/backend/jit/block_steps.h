// The function of a block as a list of steps with a plan of its registers.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/backend/jit/computation_emitter.h"
#include "sinew/backend/jit/register_plan.h"
#include "sinew/program/dag/dag.h"

namespace sinew::backend {

struct BlockSteps {
  std::vector<std::uint32_t> begin;  // nodes that are computed before all others
  std::vector<std::uint32_t> nodes;  // those of the steps after it, one each
  RegisterPlan plan;                 // of the beginning, these, and the results at the end
  std::uint32_t waiting = 0;         // values that are written to memory
  std::vector<std::uint32_t> input_rows, result_rows;  // in the order of access
};

// What is known before.
struct BlockProgram {
  const program::Computation& computation;
  const ComputationEmitter& emitter;
  std::vector<std::uint32_t> begin;                    // sines that are in registers at first
  std::vector<std::vector<std::uint32_t>> results_of;  // of each node that is computed
  std::vector<std::uint32_t> later;                    // results that are no operations
};

// In the computation's own order, which is made for latency, as long as few values wait; else in
// the better one of block_order.h.
BlockSteps plan_block(const BlockProgram& program, std::uint32_t registers);

}  // namespace sinew::backend
