// What solutions go through: groups, sorting, projection, DISTINCT, OFFSET and LIMIT (SPARQL 1.1,
// section 18.2.5).
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "sinew/rdf/sparql/eval/state.h"
#include "sinew/rdf/sparql/values/operators.h"

namespace sinew::rdf::sparql::eval {

using plan::Block;

void Evaluator::run_block(Index index, RowVisitor visit) {
  const Block& block = plan_->blocks[index];
  BlockState& state = blocks_[index];
  if (block.limit == std::uint64_t{0}) return;
  state.visit = &visit;
  state.skipped = state.delivered = 0;
  state.after_groups = false;
  state.row.resize(block.columns.size() + block.order.size());
  if (block.distinct) state.distinct.begin(block.columns.size());
  state.rows.clear();
  if (block.grouped) {
    state.groups.begin(block.keys.size());
    state.accumulators.clear();
    state.distinct_values.resize(block.aggregates.size());
    for (std::size_t i = 0; i < block.aggregates.size(); ++i) {
      const bool whole = block.aggregates[i].argument == plan::kNone;
      state.distinct_values[i].begin(1 + (whole ? block.solution.size() : 1));
    }
  }
  run(block.first);
  if (block.grouped) run_groups(block, state);
  if (!block.order.empty()) sort_rows(block, state);
}

// A solution is complete. False when no more are wanted.
bool Evaluator::emit(Index index) {
  const Block& block = plan_->blocks[index];
  BlockState& state = blocks_[index];
  tick();
  if (block.grouped && !state.after_groups) {
    add_to_group(block, state);
    return true;
  }
  space_.forget_labels();  // BNODE("x") is one node in one solution
  const std::size_t width = block.columns.size();
  for (std::size_t i = 0; i < width; ++i) state.row[i] = slots_[block.columns[i]];
  if (block.order.empty()) return deliver(block, state, {state.row.data(), width});
  for (std::size_t i = 0; i < block.order.size(); ++i) {
    state.row[width + i] = term(block.order[i].expression);
  }
  state.rows.insert(state.rows.end(), state.row.begin(), state.row.end());
  if (state.rows.size() / state.row.size() > limits_.rows) {
    fail(fmt::format("more than {} solutions are to be sorted", limits_.rows),
         "make the query more specific, or raise Limits::rows");
  }
  return true;
}

bool Evaluator::deliver(const Block& block, BlockState& state, std::span<const Id> row) {
  if (block.distinct && !state.distinct.insert(row).is_new) return true;
  if (state.skipped < block.offset) {
    ++state.skipped;
    return true;
  }
  if (++state.delivered > limits_.rows) {
    fail(fmt::format("the query has more than {} solutions", limits_.rows),
         "add LIMIT, make the query more specific, or raise Limits::rows");
  }
  if (!(*state.visit)(row)) return false;
  return !block.limit || state.delivered < *block.limit;
}

void Evaluator::sort_rows(const Block& block, BlockState& state) {
  const std::size_t stride = block.columns.size() + block.order.size();
  const std::size_t count = state.rows.size() / stride;
  state.order.resize(count);
  std::iota(state.order.begin(), state.order.end(), std::size_t{0});
  const auto before = [&](std::size_t a, std::size_t b) {
    const Id* const left = state.rows.data() + a * stride + block.columns.size();
    const Id* const right = state.rows.data() + b * stride + block.columns.size();
    for (std::size_t i = 0; i < block.order.size(); ++i) {
      tick();
      const int result = values::order(left[i], right[i], space_);
      if (result != 0) return block.order[i].descending ? result > 0 : result < 0;
    }
    // Solutions that compare equal stay in the order in which they were found.
    return a < b;
  };
  std::sort(state.order.begin(), state.order.end(), before);
  for (const std::size_t row : state.order) {
    if (!deliver(block, state, {state.rows.data() + row * stride, block.columns.size()})) return;
  }
}

}  // namespace sinew::rdf::sparql::eval
