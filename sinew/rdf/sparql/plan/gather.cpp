// Patterns to items: groups within groups become one list wherever that keeps their meaning.
#include <algorithm>
#include <unordered_map>

#include "sinew/rdf/sparql/plan/planner_class.h"
#include "sinew/rdf/sparql/plan/safety.h"

namespace sinew::rdf::sparql::plan {

using Kind = Pattern::Kind;

Variable Planner::fresh_variable() { return next_variable_++; }

Item& Planner::add_here(Item::Kind kind, const Pattern& pattern, const Context& context,
                        std::vector<Item>& items) {
  Item& item = items.emplace_back();
  item.kind = kind;
  item.pattern = &pattern;
  item.graph_kind = context.graph_kind;
  item.graph = context.graph;
  item.possible = pattern.possible;
  item.certain = pattern.certain;
  return item;
}

namespace {

// The expression waits for those of its variables that the items of its own pattern may bind.
void wait_for(Item& item, VariableSet used, const Pattern& inner, std::size_t begin,
              std::size_t end) {
  used.keep_only(inner.possible);
  item.needs = std::move(used);
  item.scope_begin = begin;
  item.scope_end = end;
}

}  // namespace

void Planner::gather(const Pattern& pattern, const Context& context, std::vector<Item>& items) {
  const std::size_t begin = items.size();
  switch (pattern.kind) {
    case Kind::kTriples:
      gather_triples(pattern, context, items);
      return;
    case Kind::kJoin:
      gather_join(pattern, context, items);
      return;
    case Kind::kGraph:
      gather_graph(pattern, context, items);
      return;
    case Kind::kSelect:
      gather_select(pattern, context, items);
      return;
    case Kind::kFilter: {
      gather(pattern.parts[0], context, items);
      const std::size_t end = items.size();
      for (const algebra::Expression& condition : pattern.conditions) {
        Item& item = items.emplace_back();
        item.kind = Item::Kind::kFilter;
        item.expression = &condition;
        item.visible = &pattern.parts[0].possible;
        item.graph_kind = context.graph_kind;
        item.graph = context.graph;
        wait_for(item, algebra::variables_of(condition), pattern.parts[0], begin, end);
      }
      return;
    }
    case Kind::kExtend: {
      gather(pattern.parts[0], context, items);
      Item& item = items.emplace_back();
      item.kind = Item::Kind::kExtend;
      item.expression = &pattern.expression;
      item.variable = pattern.variable;
      item.visible = &pattern.parts[0].possible;
      item.graph_kind = context.graph_kind;
      item.graph = context.graph;
      item.possible = {pattern.variable};
      if (pattern.expression.op == Operator::kConstant) item.certain = item.possible;
      wait_for(item, algebra::variables_of(pattern.expression), pattern.parts[0], begin,
               items.size() - 1);
      return;
    }
    case Kind::kLeftJoin:
    case Kind::kMinus: {
      gather(pattern.parts[0], context, items);
      const std::size_t end = items.size();
      const bool is_minus = pattern.kind == Kind::kMinus;
      Item& item = items.emplace_back();
      item.kind = is_minus ? Item::Kind::kMinus : Item::Kind::kOptional;
      item.pattern = &pattern;
      item.graph_kind = context.graph_kind;
      item.graph = context.graph;
      VariableSet used =
          is_minus ? pattern.parts[1].possible : algebra::mentioned(pattern.parts[1]);
      for (const auto& condition : pattern.conditions) used.add(algebra::variables_of(condition));
      if (!is_minus) {
        item.possible = pattern.parts[1].possible;
        item.possible.remove(pattern.parts[0].certain);
      }
      wait_for(item, std::move(used), pattern.parts[0], begin, end);
      return;
    }
    case Kind::kUnion:
      add_here(Item::Kind::kUnion, pattern, context, items);
      return;
    case Kind::kValues:
      add_here(Item::Kind::kValues, pattern, context, items);
      return;
    case Kind::kService:
      if (!pattern.silent) add_here(Item::Kind::kRefuse, pattern, context, items);
      return;
  }
}

void Planner::gather_safely(const Pattern& pattern, const Context& context,
                            std::vector<Item>& items) {
  if (safe_inside(pattern, context.maybe)) {
    gather(pattern, context, items);
  } else {
    add_here(Item::Kind::kTable, pattern, context, items);
  }
}

void Planner::gather_triples(const Pattern& pattern, const Context& context,
                             std::vector<Item>& items) {
  for (const algebra::Triple& triple : pattern.triples) gather_triple(triple, context, items);
}

// Sequences and inverses of a path become triples (SPARQL 1.1, section 18.2.2.4).
void Planner::gather_triple(const algebra::Triple& triple, const Context& context,
                            std::vector<Item>& items) {
  using PathKind = syntax::Path::Kind;
  if (triple.path) {
    const syntax::Path& path = *triple.path;
    const auto part = [&](const syntax::Path& of) {
      return std::shared_ptr<const syntax::Path>(triple.path, &of);
    };
    if (path.kind == PathKind::kInverse) {
      gather_triple({triple.object, {}, triple.subject, part(path.parts[0])}, context, items);
      return;
    }
    if (path.kind == PathKind::kSequence) {
      algebra::Node from = triple.subject;
      for (std::size_t i = 0; i < path.parts.size(); ++i) {
        const bool last = i + 1 == path.parts.size();
        const algebra::Node to = last ? triple.object : algebra::Node::variable(fresh_variable());
        gather_triple({from, {}, to, part(path.parts[i])}, context, items);
        from = to;
      }
      return;
    }
    if (path.kind == PathKind::kIri) {
      gather_triple({triple.subject, algebra::Node::term(path.iri), triple.object, nullptr},
                    context, items);
      return;
    }
  }
  Item& item = items.emplace_back();
  item.kind = triple.path ? Item::Kind::kPath : Item::Kind::kTriple;
  item.triple = triple;
  item.graph_kind = context.graph_kind;
  item.graph = context.graph;
  for (const algebra::Node node : {triple.subject, triple.predicate, triple.object}) {
    if (node.is_variable) item.possible.add(node.value);
  }
  item.certain = item.possible;
}

void Planner::gather_join(const Pattern& pattern, const Context& context,
                          std::vector<Item>& items) {
  // In how many parts a variable may be bound.
  std::unordered_map<Variable, std::size_t> binders;
  for (const Pattern& part : pattern.parts) {
    for (const Variable variable : part.possible) ++binders[variable];
  }
  const auto safe_among_others = [&](const Pattern& part) {
    if (part.kind == Kind::kTriples || part.kind == Kind::kValues) return true;
    VariableSet others;
    for (const Variable variable : algebra::mentioned(part)) {
      const auto found = binders.find(variable);
      const std::size_t count = found == binders.end() ? 0 : found->second;
      const bool bound_elsewhere = count > (part.possible.has(variable) ? 1u : 0u);
      if (bound_elsewhere || context.maybe.has(variable)) others.add(variable);
    }
    others.remove(context.fixed);
    return safe_inside(part, others);
  };
  // A first part into which nothing may flow can also run before all others.
  std::size_t barrier = 0;
  for (const Pattern& part : pattern.parts) {
    const std::size_t begin = items.size();
    const bool is_first = &part == &pattern.parts.front();
    if (safe_among_others(part)) {
      gather(part, context, items);
    } else if (is_first && begin == 0 && safe_inside(part, context.maybe)) {
      gather(part, context, items);
      barrier = items.size();
    } else {
      add_here(Item::Kind::kTable, part, context, items);
    }
    if (is_first) continue;
    for (std::size_t i = begin; i < items.size(); ++i) items[i].barrier = barrier;
  }
}

namespace {

// Patterns in which the graph's variable can simply be one more position of each triple.
bool can_spread(const Pattern& part, Variable graph) {
  switch (part.kind) {
    case Kind::kTriples:
      return needs_a_triple(part);
    case Kind::kJoin:
      return !part.parts.empty() &&
             std::all_of(part.parts.begin(), part.parts.end(),
                         [&](const Pattern& inner) { return can_spread(inner, graph); });
    case Kind::kFilter:
      // A filter sees the graph's variable only if the pattern inside binds it; EXISTS would need
      // it.
      return can_spread(part.parts[0], graph) &&
             std::none_of(part.conditions.begin(), part.conditions.end(),
                          [&](const algebra::Expression& condition) {
                            return algebra::variables_of(condition).has(graph) ||
                                   has_exists(condition);
                          });
    case Kind::kLeftJoin:
      return can_spread(part.parts[0], graph) && part.conditions.empty() &&
             part.parts[1].kind == Kind::kTriples && !part.parts[1].possible.has(graph);
    default:
      return false;
  }
}

}  // namespace

void Planner::gather_graph(const Pattern& pattern, const Context& context,
                           std::vector<Item>& items) {
  const Pattern& part = pattern.parts[0];
  const bool is_known = !pattern.name.is_variable || context.constants.has(pattern.name.value);
  const bool spreads = is_known ? needs_a_triple(part) : can_spread(part, pattern.name.value);
  if (!spreads) {
    add_here(Item::Kind::kScope, pattern, context, items);
    return;
  }
  Context inside = context;
  inside.graph_kind = GraphKind::kNamed;
  inside.graph = node(pattern.name, context);
  const std::size_t begin = items.size();
  gather(part, inside, items);
  if (is_known) return;
  for (std::size_t i = begin; i < items.size(); ++i) {
    if (items[i].kind == Item::Kind::kTriple || items[i].kind == Item::Kind::kPath) {
      items[i].possible.add(pattern.name.value);
      items[i].certain.add(pattern.name.value);
    } else if (items[i].kind == Item::Kind::kOptional) {
      items[i].needs.add(pattern.name.value);
    }
  }
}

void Planner::gather_select(const Pattern& pattern, const Context& context,
                            std::vector<Item>& items) {
  const algebra::Select& select = *pattern.select;
  if (!is_plain(select)) {
    add_here(Item::Kind::kTable, pattern, context, items);
    return;
  }
  const std::size_t begin = items.size();
  gather(select.where, context, items);
  VariableSet assigned;
  for (const algebra::Assignment& assignment : select.assignments) {
    const std::size_t end = items.size();
    Item& item = items.emplace_back();
    item.kind = Item::Kind::kExtend;
    item.expression = &assignment.expression;
    item.variable = assignment.variable;
    item.visible = &select.where.possible;
    item.extra_visible = assigned;
    item.graph_kind = context.graph_kind;
    item.graph = context.graph;
    item.possible = {assignment.variable};
    VariableSet seen = select.where.possible;
    seen.add(assigned);
    item.needs = algebra::variables_of(assignment.expression);
    item.needs.keep_only(seen);
    item.scope_begin = begin;
    item.scope_end = end;
    assigned.add(assignment.variable);
  }
}

}  // namespace sinew::rdf::sparql::plan
