// Parts that are evaluated on their own and joined as tables, and MINUS.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/rdf/sparql/eval/state.h"

namespace sinew::rdf::sparql::eval {

using plan::Block;
using plan::Op;
using plan::SubPlan;

// The rows of the sub-plan, made when they are first needed, and again when what they depend on
// changes.
const Evaluator::TableState& Evaluator::table(Index index) {
  const SubPlan& sub_plan = plan_->tables[index];
  const Block& block = plan_->blocks[sub_plan.block];
  TableState& state = tables_[index];
  const auto same = [&] {
    for (std::size_t i = 0; i < sub_plan.depends.size(); ++i) {
      if (slots_[sub_plan.depends[i]] != state.depended[i]) return false;
    }
    return true;
  };
  if (state.is_made && same()) return state;
  state.depended.clear();
  for (const Slot slot : sub_plan.depends) state.depended.push_back(slots_[slot]);
  state.rows.clear();
  state.width = block.columns.size();
  state.count = 0;

  // Nothing of the solutions around is seen, but constants and what counts as such.
  const std::size_t saved = saved_.size();
  saved_.insert(saved_.end(), slots_.begin(), slots_.end());
  std::copy(plan_->initial.begin(), plan_->initial.end(), slots_.begin());
  std::copy_n(saved_.begin() + static_cast<std::ptrdiff_t>(saved), plan_->parameter_count,
              slots_.begin());
  for (const Slot slot : sub_plan.depends) slots_[slot] = saved_[saved + slot];
  run_block(sub_plan.block, [&](std::span<const Id> row) {
    state.rows.insert(state.rows.end(), row.begin(), row.end());
    ++state.count;
    return true;
  });
  std::copy_n(saved_.begin() + static_cast<std::ptrdiff_t>(saved), slots_.size(), slots_.begin());
  saved_.resize(saved);

  if (!sub_plan.key.empty()) {
    state.keys.begin(sub_plan.key.size());
    state.first.clear();
    state.last.clear();
    state.next.assign(state.count, RowSet::kNotThere);
    std::vector<Id> key(sub_plan.key.size());
    for (std::size_t row = 0; row < state.count; ++row) {
      for (std::size_t i = 0; i < key.size(); ++i) {
        key[i] = state.rows[row * state.width + sub_plan.key[i]];
      }
      const auto [group, is_new] = state.keys.insert(key);
      if (is_new) {
        state.first.push_back(row);
        state.last.push_back(row);
      } else {
        state.next[state.last[group]] = row;
        state.last[group] = row;
      }
    }
  }
  state.is_made = true;
  return state;
}

bool Evaluator::join_table(const Op& op) {
  tick();
  const SubPlan& sub_plan = plan_->tables[op.item];
  const Block& block = plan_->blocks[sub_plan.block];
  const TableState& state = table(op.item);
  const std::size_t saved = save(block.columns);
  bool go_on = true;
  const auto join = [&](std::size_t row) {
    tick();
    if (bind_row(block.columns, state.rows.data() + row * state.width)) go_on = run(op.next);
    restore(block.columns, saved);
  };
  if (sub_plan.key.empty()) {
    for (std::size_t row = 0; go_on && row < state.count; ++row) join(row);
  } else {
    const std::size_t key = saved_.size();
    for (const Index column : sub_plan.key) saved_.push_back(slots_[block.columns[column]]);
    const std::size_t group = state.keys.index_of({saved_.data() + key, sub_plan.key.size()});
    saved_.resize(key);
    if (group != RowSet::kNotThere) {
      for (std::size_t row = state.first[group]; go_on && row != RowSet::kNotThere;
           row = state.next[row]) {
        join(row);
      }
    }
  }
  saved_.resize(saved);
  return go_on;
}

// False when a row of the table is compatible with the present solution and shares a variable with
// it.
bool Evaluator::survives_minus(const Op& op) {
  tick();
  const Block& block = plan_->blocks[plan_->tables[op.item].block];
  const TableState& state = table(op.item);
  for (std::size_t row = 0; row < state.count; ++row) {
    tick();
    bool shares = false;
    bool compatible = true;
    for (std::size_t i = 0; compatible && i < state.width; ++i) {
      const Id here = slots_[block.columns[i]];
      const Id there = state.rows[row * state.width + i];
      if (!here || !there) continue;
      shares = true;
      compatible = here == there;
    }
    if (shares && compatible) return false;
  }
  return true;
}

}  // namespace sinew::rdf::sparql::eval
