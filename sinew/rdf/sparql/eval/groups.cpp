// GROUP BY and aggregates (SPARQL 1.1, section 18.5.1).
#include <fmt/format.h>

#include "sinew/rdf/sparql/eval/state.h"
#include "sinew/rdf/sparql/values/operators.h"

namespace sinew::rdf::sparql::eval {

using plan::Aggregate;
using plan::Block;
using values::ValueKind;

namespace {

// MIN and MAX keep the first or the last in the order of ORDER BY.
void keep_extreme(Accumulator& into, const Aggregate& aggregate, Id id,
                  const values::TermSpace& space) {
  if (!into.best) {
    into.best = id;
    return;
  }
  const int order = values::order(id, into.best, space);
  if (aggregate.op == Operator::kMinimum ? order < 0 : order > 0) into.best = id;
}

void add_value(Accumulator& into, const Aggregate& aggregate, Id id, values::TermSpace& space) {
  ++into.count;
  switch (aggregate.op) {
    case Operator::kSum:
    case Operator::kAverage: {
      Value number = values::value_of(id, space);
      if (into.count == 1) into.sum = Value::of_integer(0);
      into.sum = values::arithmetic(Operator::kAdd, into.sum, number);
      if (!into.sum) into.failed = true;
      break;
    }
    case Operator::kMinimum:
    case Operator::kMaximum:
      keep_extreme(into, aggregate, id, space);
      break;
    case Operator::kSample:
      if (!into.best) into.best = id;
      break;
    case Operator::kGroupConcat:
      if (space.kind(id) == graph::TermKind::kBlank) {
        into.failed = true;
        break;
      }
      if (into.count > 1) into.text += aggregate.separator;
      into.text += space.text(id);
      break;
    default:
      break;
  }
}

Id result_of(const Accumulator& from, const Aggregate& aggregate, values::TermSpace& space) {
  if (aggregate.op == Operator::kCount) {
    return values::term_of(Value::of_integer(static_cast<std::int64_t>(from.count)), space);
  }
  if (from.failed) return {};
  switch (aggregate.op) {
    case Operator::kSum:
    case Operator::kAverage: {
      if (from.count == 0) return values::term_of(Value::of_integer(0), space);
      if (aggregate.op == Operator::kSum) return values::term_of(from.sum, space);
      const Value count = Value::of_integer(static_cast<std::int64_t>(from.count));
      return values::term_of(values::arithmetic(Operator::kDivide, from.sum, count), space);
    }
    case Operator::kGroupConcat:
      return values::term_of(Value::of_string(from.text), space);
    default:
      return from.best;  // of no values: unbound
  }
}

}  // namespace

void Evaluator::add_to_group(const Block& block, BlockState& state) {
  state.key.clear();
  for (const plan::Assignment& key : block.keys) state.key.push_back(term(key.expression));
  const auto [group, is_new] = state.groups.insert(state.key);
  const std::size_t width = block.aggregates.size();
  if (is_new) {
    if (state.groups.size() > limits_.rows) {
      fail(fmt::format("there are more than {} groups", limits_.rows),
           "make the query more specific, or raise Limits::rows");
    }
    state.accumulators.resize(state.accumulators.size() + width);
  }
  for (std::size_t i = 0; i < width; ++i) {
    const Aggregate& aggregate = block.aggregates[i];
    Accumulator& into = state.accumulators[group * width + i];
    // A key of DISTINCT values begins with the number of the group.
    const Id group_number{static_cast<std::uint32_t>(group)};
    if (aggregate.argument == plan::kNone) {
      if (aggregate.distinct) {
        state.key.assign(1, group_number);
        for (const Slot slot : block.solution) state.key.push_back(slots_[slot]);
        if (!state.distinct_values[i].insert(state.key).is_new) continue;
      }
      ++into.count;
      continue;
    }
    const Id id = term(aggregate.argument);
    if (!id) {
      // COUNT and SAMPLE leave errors out; of anything else they make an error.
      into.failed |= aggregate.op != Operator::kCount && aggregate.op != Operator::kSample;
      continue;
    }
    const Id key[] = {group_number, id};
    if (aggregate.distinct && !state.distinct_values[i].insert(key).is_new) continue;
    add_value(into, aggregate, id, space_);
    if (into.text.size() > limits_.computed_bytes) {
      fail(fmt::format("GROUP_CONCAT makes a text of more than {} bytes", limits_.computed_bytes),
           "concatenate less, or raise Limits::computed_bytes");
    }
  }
}

void Evaluator::run_groups(const Block& block, BlockState& state) {
  // Without keys there is always one group, even of no solutions.
  if (block.keys.empty() && state.groups.size() == 0) {
    state.groups.insert({});
    state.accumulators.resize(block.aggregates.size());
  }
  state.after_groups = true;
  std::vector<Slot> touched;
  for (const plan::Assignment& key : block.keys) touched.push_back(key.slot);
  for (const Aggregate& aggregate : block.aggregates) touched.push_back(aggregate.result);
  const std::size_t saved = save(touched);
  const std::size_t width = block.aggregates.size();
  for (std::size_t group = 0; group < state.groups.size(); ++group) {
    const auto key = state.groups.row(group);
    for (std::size_t i = 0; i < block.keys.size(); ++i) slots_[block.keys[i].slot] = key[i];
    for (std::size_t i = 0; i < width; ++i) {
      const Aggregate& aggregate = block.aggregates[i];
      slots_[aggregate.result] =
          result_of(state.accumulators[group * width + i], aggregate, space_);
    }
    const bool go_on = run(block.after_groups);
    restore(touched, saved);
    if (!go_on) break;
  }
  saved_.resize(saved);
}

}  // namespace sinew::rdf::sparql::eval
