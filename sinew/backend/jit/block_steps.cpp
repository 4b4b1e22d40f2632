#include "sinew/backend/jit/block_steps.h"

#include <algorithm>
#include <utility>

#include "sinew/backend/jit/block_order.h"

namespace sinew::backend {
namespace {

using program::Op;

// Steps for which what lies in memory is held from one reader to the next: a second read costs more
// than the register.
constexpr std::uint32_t kLongest = 100;
// From so many values that wait on, writing them costs more than waiting for operations does.
constexpr std::uint32_t kManyWaiting = 150;

std::vector<std::uint32_t> rows_of_inputs(const BlockProgram& program, const ValueSteps& steps,
                                          const RegisterPlan& plan) {
  std::vector<std::uint32_t> rows;
  std::vector<bool> held(steps.values(), false);
  for (std::uint32_t step = 0; step < steps.size(); ++step) {
    for (const std::uint32_t value : steps.reads(step)) {
      const program::Node& node = program.computation.dag.node(value);
      if (node.op == Op::kInput && !held[value]) rows.push_back(node.index);
      held[value] = true;
    }
    for (const std::uint32_t value : plan.leaving[step]) held[value] = false;
  }
  return rows;
}

BlockSteps plan_in_order(const BlockProgram& program, const std::vector<std::uint32_t>& order,
                         std::uint32_t registers) {
  BlockSteps result;
  result.begin = program.begin;
  ValueSteps steps(program.computation.dag.size());
  for (const std::uint32_t value : program.begin) steps.define(value);
  steps.end();
  for (const std::uint32_t node : order) {
    if (!program.emitter.is_statement(node)) continue;
    program.emitter.for_each_operand(node, [&](std::uint32_t operand) { steps.read(operand); });
    steps.define(node);
    steps.end();
    result.nodes.push_back(node);
    const auto& results = program.results_of[node];
    result.result_rows.insert(result.result_rows.end(), results.begin(), results.end());
  }
  for (const std::uint32_t i : program.later) {
    steps.read(program.computation.results[i].node());
    result.result_rows.push_back(i);
  }
  steps.end();
  result.plan = plan_registers(steps, registers, kLongest);
  const auto& slots = result.plan.slot;
  result.waiting = static_cast<std::uint32_t>(std::count_if(
      slots.begin(), slots.end(), [](std::uint32_t slot) { return slot != kNoSlot; }));
  result.input_rows = rows_of_inputs(program, steps, result.plan);
  return result;
}

}  // namespace

BlockSteps plan_block(const BlockProgram& program, std::uint32_t registers) {
  const program::Computation& computation = program.computation;
  if (!computation.order.empty()) {
    BlockSteps given = plan_in_order(program, program.emitter.order(), registers);
    if (given.waiting < kManyWaiting) return given;
  }
  // What is computed depth first waits for itself, so it must save a good part of the memory.
  BlockSteps frugal = plan_in_order(program, frugal_order(computation), registers);
  BlockSteps deep = plan_in_order(program, depth_first_order(computation), registers);
  return 2 * deep.waiting < frugal.waiting ? std::move(deep) : std::move(frugal);
}

}  // namespace sinew::backend
