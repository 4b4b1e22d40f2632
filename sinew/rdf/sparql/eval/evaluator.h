// Runs a plan on a view of the graph.
//
// Solutions are pushed: each operator sets slots, has the rest of the operators run, and takes its
// bindings back. So nothing is allocated for conjunctive queries with paths, OPTIONAL, EXISTS and
// UNION once the evaluator has run before: it keeps its memory. One evaluator serves one evaluation
// at a time.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/sparql/eval/chain_memory.h"
#include "sinew/rdf/sparql/eval/function_ref.h"
#include "sinew/rdf/sparql/eval/row_set.h"
#include "sinew/rdf/sparql/eval/text_memory.h"
#include "sinew/rdf/sparql/eval/visited_set.h"
#include "sinew/rdf/sparql/plan/plan.h"
#include "sinew/rdf/sparql/syntax/limits.h"
#include "sinew/rdf/sparql/values/regex.h"
#include "sinew/rdf/sparql/values/value.h"

namespace sinew::rdf::sparql::eval {

using graph::Id;
using plan::Index;
using plan::Slot;
using values::Truth;
using values::Value;

using RowVisitor = FunctionRef<bool(std::span<const Id>)>;

class Evaluator {
 public:
  explicit Evaluator(std::shared_ptr<const plan::Plan> plan);
  ~Evaluator();
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;

  // Calls visit for each row, until it returns false; returns how many it visited. Computed terms
  // in a row are ids of `space()`.
  std::size_t select(const graph::View& view, std::span<const Id> parameters, const Limits& limits,
                     RowVisitor visit);
  // Whether there is a solution; stops at the first.
  bool ask(const graph::View& view, std::span<const Id> parameters, const Limits& limits);

  values::TermSpace& space() { return space_; }
  const plan::Plan& plan() const { return *plan_; }

 private:
  // --- evaluator.cpp ---
  void begin(const graph::View& view, std::span<const Id> parameters, const Limits& limits);
  bool run(Index at);
  bool match_triple(const plan::Op& op);
  bool graph_names(const plan::Op& op);
  bool differ(const plan::Op& op);
  bool extend(const plan::Op& op);
  bool optional(const plan::Op& op);
  bool values_rows(const plan::Op& op);
  bool finds(Index body);
  std::size_t save(std::span<const Slot> slots);
  void restore(std::span<const Slot> slots, std::size_t saved);
  bool bind_row(std::span<const Slot> slots, const Id* cells);
  void tick() {
    if ((++ticks_ & 0x3FF) == 0 && has_deadline_) check_time();
  }
  void check_time() const;
  [[noreturn]] void fail(std::size_t offset, std::string what, std::string remedy) const;
  [[noreturn]] void fail(std::string what, std::string remedy) const;

  // --- matching.h ---
  template <typename Visit>
  bool match(plan::GraphKind kind, Slot graph, Id subject, Id predicate, Id object, Visit&& visit);
  template <typename Visit>
  bool match_merged(Id subject, Id predicate, Id object, Visit&& visit);
  bool is_named_graph(Id graph) const;

  // --- paths.cpp ---
  using NodeVisitor = FunctionRef<bool(Id)>;
  bool match_path(const plan::Op& op);
  bool path_in_graph(const plan::Op& op);
  bool path_from_everywhere(const plan::Op& op);
  bool is_node(Id id);
  bool walk(std::uint32_t step, Id from, NodeVisitor visit);
  bool walk_sequence(const plan::PathStep& step, std::uint32_t part, Id from, NodeVisitor visit);
  bool walk_closure(const plan::PathStep& step, Id from, NodeVisitor visit);
  bool walk_negated(const plan::PathStep& step, Id from, NodeVisitor visit);
  void find_starts(std::uint32_t step, VisitedSet& into);
  void count_path_step() { count_path_steps(1); }
  void count_path_steps(std::size_t count) {
    tick();
    path_steps_ += count;
    if (path_steps_ > limits_.path_steps) fail_long_path();
  }
  [[noreturn]] void fail_long_path() const;

  // --- chains.cpp ---
  bool can_walk_chain(const plan::PathStep& step) const;
  bool walk_chain(const plan::PathStep& step, Id from, NodeVisitor visit);

  // --- blocks.cpp ---
  struct BlockState;
  struct TableState;
  void run_block(Index block, RowVisitor visit);
  bool emit(Index block);
  bool deliver(const plan::Block& block, BlockState& state, std::span<const Id> row);
  void add_to_group(const plan::Block& block, BlockState& state);
  void run_groups(const plan::Block& block, BlockState& state);
  void sort_rows(const plan::Block& block, BlockState& state);

  // --- tables.cpp ---
  const TableState& table(Index index);
  bool join_table(const plan::Op& op);
  bool join_row(const plan::Op& op, const plan::Block& block, const TableState& rows,
                std::size_t row);
  bool survives_minus(const plan::Op& op);

  // --- expressions.cpp, functions_*.cpp ---
  Truth condition(Index expression);
  // Evaluates and makes a term; the null id on error.
  Id term(Index expression);
  Value value(Index expression);
  Value argument(const plan::Expression& call, std::uint32_t number) {
    return value(plan_->arguments[call.first + number]);
  }
  Id leaf(const plan::Expression& call, std::uint32_t number) const;
  Truth compare(const plan::Expression& expression);
  Truth all_of(const plan::Expression& expression);
  Truth any_of(const plan::Expression& expression);
  Truth in_list(const plan::Expression& expression);
  Value call_builtin(const plan::Expression& call);
  Value test_term(const plan::Expression& call);
  Value part_of_term(const plan::Expression& call);
  Value make_term(const plan::Expression& call);
  Value cast_function(const plan::Expression& call);
  Value string_function(const plan::Expression& call);
  Value concatenated(const plan::Expression& call);
  Value regex_function(const plan::Expression& call);
  Value digest_function(const plan::Expression& call);
  Value number_function(const plan::Expression& call);
  Value time_function(const plan::Expression& call);
  Value now();
  std::uint64_t random_bits();
  std::string random_uuid();
  // A string whose text lives until the expression is done.
  Value kept_string(std::string_view text, std::string_view language = {});
  Value made(Id id);
  void check_text_size(std::size_t bytes) const;

  std::shared_ptr<const plan::Plan> plan_;
  graph::View view_;
  Limits limits_;
  std::vector<Id> slots_;
  std::vector<std::uint8_t> flags_;
  std::vector<Id> saved_;  // a stack of slots' terms set aside
  std::vector<VisitedSet> visited_;
  std::vector<ChainMemory> chains_;
  std::vector<BlockState> blocks_;
  std::vector<TableState> tables_;
  values::TermSpace space_;
  TextMemory texts_;
  // The graph that a path is walked in.
  plan::GraphKind path_graph_kind_ = plan::GraphKind::kDefault;
  Slot path_graph_ = 0;

  struct CachedRegex {
    bool is_made = false;
    std::string pattern, flags;
    std::shared_ptr<const values::Regex> regex;
  };
  std::vector<CachedRegex> regexes_;
  std::optional<std::mt19937_64> random_;  // seeded when it is first used
  std::optional<Value> now_;

  std::uint64_t ticks_ = 0;
  bool has_deadline_ = false;
  std::chrono::steady_clock::time_point deadline_;
  std::size_t path_steps_ = 0;
};

}  // namespace sinew::rdf::sparql::eval
