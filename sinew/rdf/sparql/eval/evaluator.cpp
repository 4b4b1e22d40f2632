#include "sinew/rdf/sparql/eval/evaluator.h"

#include <fmt/format.h>

#include <utility>

#include "sinew/rdf/sparql/eval/matching.h"
#include "sinew/rdf/sparql/eval/state.h"
#include "sinew/rdf/sparql/values/operators.h"

namespace sinew::rdf::sparql::eval {

using plan::GraphKind;
using plan::kNone;
using plan::Op;
using plan::OpKind;

Evaluator::Evaluator(std::shared_ptr<const plan::Plan> plan)
    : plan_(std::move(plan)),
      view_(nullptr, nullptr, 0, 0),
      slots_(plan_->initial),
      flags_(plan_->flag_count, 0),
      visited_(plan_->paths.visited_count),
      chains_(plan_->paths.chain_count),
      blocks_(plan_->blocks.size()),
      tables_(plan_->tables.size()),
      regexes_(plan_->cache_count) {}

Evaluator::~Evaluator() = default;

void Evaluator::begin(const graph::View& view, std::span<const Id> parameters,
                      const Limits& limits) {
  if (parameters.size() != plan_->parameter_count) {
    fail(fmt::format("the query has {} parameters and is given {}", plan_->parameter_count,
                     parameters.size()),
         "give one term for each parameter that was declared");
  }
  view_ = view;
  limits_ = limits;
  std::copy(plan_->initial.begin(), plan_->initial.end(), slots_.begin());
  std::copy(parameters.begin(), parameters.end(), slots_.begin());
  space_.begin(view.terms(), limits.computed_bytes);
  for (TableState& table : tables_) table.is_made = false;
  saved_.clear();
  now_.reset();
  ticks_ = 0;
  path_steps_ = 0;
  has_deadline_ = limits.time.count() > 0;
  if (has_deadline_) deadline_ = std::chrono::steady_clock::now() + limits.time;
}

std::size_t Evaluator::select(const graph::View& view, std::span<const Id> parameters,
                              const Limits& limits, RowVisitor visit) {
  begin(view, parameters, limits);
  std::size_t count = 0;
  run_block(0, [&](std::span<const Id> row) {
    ++count;
    return visit(row);
  });
  return count;
}

bool Evaluator::ask(const graph::View& view, std::span<const Id> parameters, const Limits& limits) {
  begin(view, parameters, limits);
  bool found = false;
  run_block(0, [&](std::span<const Id>) {
    found = true;
    return false;
  });
  return found;
}

void Evaluator::check_time() const {
  if (std::chrono::steady_clock::now() < deadline_) return;
  fail(fmt::format("the evaluation takes longer than {} ms",
                   std::chrono::duration_cast<std::chrono::milliseconds>(limits_.time).count()),
       "make the query more specific, or raise Limits::time");
}

void Evaluator::check_text_size(std::size_t bytes) const {
  if (bytes <= limits_.computed_bytes) return;
  fail(fmt::format("an expression makes a text of more than {} bytes", limits_.computed_bytes),
       "make it shorter, or raise Limits::computed_bytes");
}

void Evaluator::fail(std::size_t offset, std::string what, std::string remedy) const {
  if (plan_->source) plan_->source->fail(offset, std::move(what), std::move(remedy));
  throw Error(Problem{{}, {}, std::move(what), std::move(remedy), Severity::kError, {}});
}

void Evaluator::fail(std::string what, std::string remedy) const {
  fail(0, std::move(what), std::move(remedy));
}

// Runs the operators from `at` on for the present slots. False when everything is to stop.
bool Evaluator::run(Index at) {
  while (true) {
    const Op& op = plan_->ops[at];
    switch (op.kind) {
      case OpKind::kMatch:
        return match_triple(op);
      case OpKind::kPath:
        return match_path(op);
      case OpKind::kGraphNames:
        return graph_names(op);
      case OpKind::kFilter:
        if (condition(op.item) != Truth::kTrue) return true;
        break;
      case OpKind::kDiffer:
        if (!differ(op)) return true;
        break;
      case OpKind::kExtend:
        return extend(op);
      case OpKind::kOptional:
        return optional(op);
      case OpKind::kOptionalEnd:
        flags_[op.item] = 1;
        break;
      case OpKind::kUnion:
        for (Index i = 0; i < op.item; ++i) {
          if (!run(plan_->branches[op.body + i])) return false;
        }
        return true;
      case OpKind::kExists:
        if (finds(op.body) == op.negated) return true;
        break;
      case OpKind::kFound:
        return false;
      case OpKind::kValues:
        return values_rows(op);
      case OpKind::kTable:
        return join_table(op);
      case OpKind::kMinus:
        if (!survives_minus(op)) return true;
        break;
      case OpKind::kNothing:
        return true;
      case OpKind::kRefuse:
        fail(op.item, "SERVICE would ask another computer, which this engine never does",
             "load the data that the service has, or write SERVICE SILENT to do without");
      case OpKind::kEmit:
        return emit(op.item);
      case OpKind::kJump:
        break;
    }
    at = op.next;
  }
}

bool Evaluator::match_triple(const Op& op) {
  tick();
  Id* const slots = slots_.data();
  const Id subject = slots[op.subject];
  const Id predicate = slots[op.predicate];
  const Id object = slots[op.object];
  const Index next = op.next;
  if (op.graph_kind == GraphKind::kDefault && !op.repeats) {
    // The usual case: what is unbound is bound by the triple, and nothing needs to be compared.
    const bool go_on =
        match(GraphKind::kDefault, 0, subject, predicate, object, [&](const graph::Quad& quad) {
          slots[op.subject] = quad.subject;
          slots[op.predicate] = quad.predicate;
          slots[op.object] = quad.object;
          return run(next);
        });
    slots[op.subject] = subject;
    slots[op.predicate] = predicate;
    slots[op.object] = object;
    return go_on;
  }
  const bool has_graph = op.graph_kind == GraphKind::kNamed;
  const Id graph = has_graph ? slots[op.graph] : Id{};
  const auto restore = [&] {
    slots[op.subject] = subject;
    slots[op.predicate] = predicate;
    slots[op.object] = object;
    if (has_graph) slots[op.graph] = graph;
  };
  const bool go_on =
      match(op.graph_kind, op.graph, subject, predicate, object, [&](const graph::Quad& quad) {
        restore();
        // Where a slot stands twice, the second must agree with the first.
        const auto bind = [&](Slot slot, Id id) {
          if (slots[slot]) return slots[slot] == id;
          slots[slot] = id;
          return true;
        };
        if (!bind(op.subject, quad.subject)) return true;
        if (!bind(op.predicate, quad.predicate)) return true;
        if (!bind(op.object, quad.object)) return true;
        if (has_graph && !bind(op.graph, quad.graph)) return true;
        return run(next);
      });
  restore();
  return go_on;
}

bool Evaluator::graph_names(const Op& op) {
  const Id name = slots_[op.graph];
  const plan::DatasetPlan& dataset = plan_->dataset;
  if (name) {
    if (values::is_local(name)) return true;
    const bool exists = dataset.named_restricted ? is_named_graph(name) : view_.has_graph(name);
    return !exists || run(op.next);
  }
  const auto visit = [&](Id graph) {
    slots_[op.graph] = graph;
    return run(op.next);
  };
  bool go_on = true;
  if (dataset.named_restricted) {
    for (const Id graph : dataset.named) {
      go_on = visit(graph);
      if (!go_on) break;
    }
  } else {
    go_on = view_.named_graphs(visit);
  }
  slots_[op.graph] = {};
  return go_on;
}

// ?a != ?b (negated: =).
bool Evaluator::differ(const Op& op) {
  const Id a = slots_[op.subject];
  const Id b = slots_[op.object];
  if (!a || !b) return false;
  const Truth same = values::same_without_values(a, b, space_);
  if (same == Truth::kError) return condition(op.item) == Truth::kTrue;
  return (same == Truth::kTrue) == op.negated;
}

bool Evaluator::extend(const Op& op) {
  const Id before = slots_[op.subject];
  const Id made = term(op.item);
  if (before && made && before != made) return true;
  if (made) slots_[op.subject] = made;
  const bool go_on = run(op.next);
  slots_[op.subject] = before;
  return go_on;
}

bool Evaluator::optional(const Op& op) {
  flags_[op.item] = 0;
  if (!run(op.body)) return false;
  return flags_[op.item] != 0 || run(op.next);
}

bool Evaluator::values_rows(const Op& op) {
  const plan::ValuesTable& table = plan_->values[op.item];
  const std::size_t width = table.slots.size();
  const std::size_t saved = save(table.slots);
  bool go_on = true;
  for (std::size_t row = 0; go_on && row < table.row_count; ++row) {
    tick();
    if (bind_row(table.slots, table.cells.data() + row * width)) go_on = run(op.next);
    restore(table.slots, saved);
  }
  saved_.resize(saved);
  return go_on;
}

// Keeps the slots' terms aside; returns where.
std::size_t Evaluator::save(std::span<const Slot> slots) {
  const std::size_t saved = saved_.size();
  for (const Slot slot : slots) saved_.push_back(slots_[slot]);
  return saved;
}

void Evaluator::restore(std::span<const Slot> slots, std::size_t saved) {
  for (std::size_t i = 0; i < slots.size(); ++i) slots_[slots[i]] = saved_[saved + i];
}

// Sets the slots to a row's cells as far as both are bound; false where they disagree.
bool Evaluator::bind_row(std::span<const Slot> slots, const Id* cells) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    Id& slot = slots_[slots[i]];
    if (!cells[i]) continue;
    if (slot && slot != cells[i]) return false;
    slot = cells[i];
  }
  return true;
}

bool Evaluator::finds(Index body) {
  // The body ends in an operator that stops everything; nothing else does.
  return !run(body);
}

}  // namespace sinew::rdf::sparql::eval
