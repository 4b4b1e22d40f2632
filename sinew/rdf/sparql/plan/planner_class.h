// The planner's parts share this class: gather.cpp (patterns to items), schedule.cpp (items to an
// order), emit.cpp (items to operators), expressions.cpp, blocks.cpp (SELECTs), estimate.cpp.
// Private to this folder.
#pragma once

#include <unordered_map>
#include <vector>

#include "sinew/rdf/sparql/plan/planner.h"

namespace sinew::rdf::sparql::plan {

using algebra::Pattern;
using algebra::Variable;
using algebra::VariableSet;

// What holds where a pattern is planned.
struct Context {
  GraphKind graph_kind = GraphKind::kDefault;
  Slot graph = 0;
  // Known from outside as if it were written as a constant: parameters, the graph's variable, and
  // in EXISTS the variables of the solution that is tested.
  VariableSet constants;
  // Those of the constants that surely have a value: all, but in an EXISTS without inner scopes.
  VariableSet fixed;
  VariableSet bound;  // surely bound by what ran before, `fixed` included
  VariableSet maybe;  // perhaps, or surely, bound by what ran before, `fixed` not included
  // Variables that have another slot here, because the one they have elsewhere may hold a value
  // that must not be seen here.
  const std::unordered_map<Variable, Slot>* renamed = nullptr;
};

// One thing to be done, and what must have happened before.
struct Item {
  enum class Kind : std::uint8_t {
    kTriple,
    kPath,
    kGraphNames,
    kScope,
    kFilter,
    kExtend,
    kOptional,
    kUnion,
    kValues,
    kTable,
    kMinus,
    kRefuse
  };
  Kind kind = Kind::kTriple;
  const Pattern* pattern = nullptr;
  algebra::Triple triple;                           // kTriple, kPath
  const algebra::Expression* expression = nullptr;  // kFilter, kExtend
  Variable variable = 0;                            // kExtend, kGraphNames
  const VariableSet* visible = nullptr;             // what the expression may see
  VariableSet extra_visible;                        // and this
  GraphKind graph_kind = GraphKind::kDefault;
  Slot graph = 0;

  VariableSet needs;  // must be settled by the items [scope_begin, scope_end)
  std::size_t scope_begin = 0, scope_end = 0;
  std::size_t barrier = 0;  // all items before this one must be done
  VariableSet possible, certain;
  bool done = false;
};

class Planner {
 public:
  Planner(const algebra::Query& query, const graph::View& view, const DatasetPlan& dataset);
  std::shared_ptr<const Plan> run();

 private:
  // --- blocks.cpp ---
  Index block(const algebra::Select& select, const Context& context);
  void check_depth() const;  // depth.cpp
  [[noreturn]] void fail_too_long() const;
  Slot slot(Variable variable, const Context& context);
  Slot fresh_slot(std::string name);
  Slot constant(graph::Id id);
  Slot node(algebra::Node node, const Context& context) {
    return node.is_variable ? slot(node.value, context) : constant(graph::Id{node.value});
  }

  // --- gather.cpp ---
  void gather(const Pattern& pattern, const Context& context, std::vector<Item>& items);
  // As a table of its own where bindings must not flow in.
  void gather_safely(const Pattern& pattern, const Context& context, std::vector<Item>& items);
  void gather_triples(const Pattern& pattern, const Context& context, std::vector<Item>& items);
  void gather_triple(const algebra::Triple& triple, const Context& context,
                     std::vector<Item>& items);
  void gather_join(const Pattern& pattern, const Context& context, std::vector<Item>& items);
  void gather_graph(const Pattern& pattern, const Context& context, std::vector<Item>& items);
  void gather_select(const Pattern& pattern, const Context& context, std::vector<Item>& items);
  Item& add_here(Item::Kind kind, const Pattern& pattern, const Context& context,
                 std::vector<Item>& items);
  Variable fresh_variable();

  // --- schedule.cpp ---
  void order_and_emit(std::vector<Item>& items, Context context);
  VariableSet visible_to(const Item& item) const;
  bool ready(const Item& item, const std::vector<Item>& items, std::size_t first_undone,
             const Context& context) const;
  double cost(const Item& item, const Context& context);

  // --- estimate.cpp ---
  double triple_rows(const algebra::Triple& triple, const VariableSet& bound) const;
  double path_rows(const algebra::Triple& triple, const VariableSet& bound) const;
  double pattern_rows(const Pattern& pattern, const VariableSet& bound) const;

  // --- emit.cpp ---
  void emit_pattern(const Pattern& pattern, const Context& context);
  void emit(const Item& item, const Context& context, double estimate);
  void emit_triple(const Item& item, const Context& context);
  void emit_filter(const Item& item, const Context& context);
  void emit_extend(const Item& item, const Context& context);
  void emit_optional(const Item& item, const Context& context);
  void emit_union(const Item& item, const Context& context);
  void emit_values(const Item& item, const Context& context);
  void emit_table(const Item& item, const Context& context);
  void emit_minus(const Item& item, const Context& context);
  void emit_scope(const Item& item, const Context& context);
  // `columns`: what is kept of each row.
  Index sub_plan(const Pattern& pattern, const VariableSet& columns, const Context& context);
  // Gives variables of the pattern that must not see what they are bound to here slots of their
  // own.
  void hide(const Pattern& pattern, const Context& outer, Context& inside,
            std::unordered_map<Variable, Slot>& renamed);
  Index add_op(OpKind kind);
  Index next_op() const { return static_cast<Index>(plan_->ops.size()); }

  // --- expressions.cpp ---
  // `visible`: the variables that have a value in the expression; all others are unbound.
  Index expression(const algebra::Expression& source, const VariableSet& visible,
                   const Context& context);
  Index exists_body(const Pattern& pattern, const VariableSet& visible, const Context& context);
  void exists_variant(const Pattern& pattern, const Context& outer, Context inside);
  void exists_variants(const Pattern& pattern, const Context& outer, const Context& inside,
                       const std::vector<Variable>& open);

  const algebra::Query& query_;
  const graph::View& view_;
  std::shared_ptr<Plan> plan_;
  std::unordered_map<Variable, Slot> slots_;
  std::unordered_map<graph::Id, Slot> constants_;
  Variable next_variable_;
};

}  // namespace sinew::rdf::sparql::plan
