#include "sinew/rdf/sparql/test/reference.h"

#include <algorithm>
#include <functional>
#include <set>
#include <stdexcept>

#include "sinew/rdf/sparql/values/operators.h"

namespace sinew::rdf::sparql::reference {

using algebra::Expression;
using algebra::Pattern;
using algebra::Variable;
using graph::Id;
using graph::Quad;
using values::Truth;
using values::Value;

namespace {

bool compatible(const Solution& a, const Solution& b) {
  for (const auto& [variable, id] : a) {
    const auto found = b.find(variable);
    if (found != b.end() && found->second != id) return false;
  }
  return true;
}

Solution merge(Solution a, const Solution& b) {
  a.insert(b.begin(), b.end());
  return a;
}

Solutions join(const Solutions& left, const Solutions& right) {
  Solutions result;
  for (const Solution& a : left) {
    for (const Solution& b : right) {
      if (compatible(a, b)) result.push_back(merge(a, b));
    }
  }
  return result;
}

}  // namespace

Reference::Reference(std::vector<Quad> quads, graph::Terms& terms)
    : quads_(std::move(quads)), terms_(terms) {
  space_.begin(terms, 1 << 28);
  std::set<Id> graphs;
  for (const Quad& quad : quads_) {
    if (quad.graph) graphs.insert(quad.graph);
  }
  graphs_.assign(graphs.begin(), graphs.end());
}

std::vector<std::vector<Id>> Reference::rows(const algebra::Query& query) {
  std::vector<std::vector<Id>> result;
  for (const Solution& solution : select(query.select, {}, {})) {
    std::vector<Id>& row = result.emplace_back();
    for (const Variable column : query.select.columns) {
      const auto found = solution.find(column);
      row.push_back(found == solution.end() ? Id{} : space_.keep(found->second, terms_));
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

Solutions Reference::evaluate(const Pattern& pattern, Id graph, const Solution& constants) {
  using Kind = Pattern::Kind;
  const auto part = [&](std::size_t i) { return evaluate(pattern.parts[i], graph, constants); };
  switch (pattern.kind) {
    case Kind::kTriples:
      return triples(pattern, graph, constants);
    case Kind::kJoin: {
      Solutions result = {{}};
      for (std::size_t i = 0; i < pattern.parts.size(); ++i) result = join(result, part(i));
      return result;
    }
    case Kind::kLeftJoin: {
      Solutions result;
      const Solutions right = part(1);
      for (const Solution& a : part(0)) {
        bool matched = false;
        for (const Solution& b : right) {
          if (!compatible(a, b)) continue;
          const Solution both = merge(a, b);
          if (!holds(pattern.conditions, both, graph, constants)) continue;
          result.push_back(both);
          matched = true;
        }
        if (!matched) result.push_back(a);
      }
      return result;
    }
    case Kind::kUnion: {
      Solutions result;
      for (std::size_t i = 0; i < pattern.parts.size(); ++i) {
        for (Solution& solution : part(i)) result.push_back(std::move(solution));
      }
      return result;
    }
    case Kind::kMinus: {
      Solutions result;
      const Solutions right = part(1);
      for (const Solution& a : part(0)) {
        const bool removed = std::any_of(right.begin(), right.end(), [&](const Solution& b) {
          const bool shares = std::any_of(b.begin(), b.end(),
                                          [&](const auto& item) { return a.count(item.first); });
          return shares && compatible(a, b);
        });
        if (!removed) result.push_back(a);
      }
      return result;
    }
    case Kind::kFilter: {
      Solutions result;
      for (const Solution& a : part(0)) {
        if (holds(pattern.conditions, a, graph, constants)) result.push_back(a);
      }
      return result;
    }
    case Kind::kExtend: {
      Solutions result = part(0);
      for (Solution& a : result) {
        if (const Id id = value(pattern.expression, a, graph, constants)) a[pattern.variable] = id;
      }
      return result;
    }
    case Kind::kGraph: {
      const bool known = !pattern.name.is_variable || constants.count(pattern.name.value) > 0;
      const Id name = !pattern.name.is_variable ? Id{pattern.name.value}
                      : known                   ? constants.at(pattern.name.value)
                                                : Id{};
      Solutions result;
      for (const Id each : graphs_) {
        if (known && each != name) continue;
        const Solution bound = known ? Solution{} : Solution{{Variable{pattern.name.value}, each}};
        for (Solution& s : join({bound}, evaluate(pattern.parts[0], each, constants))) {
          result.push_back(std::move(s));
        }
      }
      return result;
    }
    case Kind::kValues: {
      Solutions result;
      for (const auto& row : pattern.value_rows) {
        Solution& solution = result.emplace_back();
        for (std::size_t i = 0; i < row.size(); ++i) {
          if (row[i]) solution[pattern.value_variables[i]] = row[i];
        }
      }
      // A constant's value is its only one.
      return join({constants}, result).empty() ? Solutions{} : [&] {
        Solutions kept;
        for (const Solution& s : result) {
          if (compatible(s, constants)) kept.push_back(s);
        }
        return kept;
      }();
    }
    case Kind::kSelect:
      return select(*pattern.select, graph, constants);
    case Kind::kService:
      break;
  }
  throw std::logic_error("the reference does not know this pattern");
}

Solutions Reference::triples(const Pattern& pattern, Id graph, const Solution& constants) {
  Solutions result = {{}};
  for (const algebra::Triple& triple : pattern.triples) {
    Solutions next;
    const auto known = [&](algebra::Node node) -> Id {
      if (!node.is_variable) return Id{node.value};
      const auto found = constants.find(node.value);
      return found == constants.end() ? Id{} : found->second;
    };
    const auto bind = [&](Solution& solution, algebra::Node node, Id id) {
      if (const Id fixed = known(node)) return fixed == id;
      return solution.emplace(node.value, id).first->second == id;
    };
    if (triple.path) {
      for (const auto& [from, to] :
           path(*triple.path, known(triple.subject), known(triple.object), graph)) {
        Solution solution;
        if (bind(solution, triple.subject, from) && bind(solution, triple.object, to)) {
          next.push_back(solution);
        }
      }
    } else {
      for (const Quad& quad : quads_) {
        if (quad.graph != graph) continue;
        Solution solution;
        if (bind(solution, triple.subject, quad.subject) &&
            bind(solution, triple.predicate, quad.predicate) &&
            bind(solution, triple.object, quad.object)) {
          next.push_back(solution);
        }
      }
    }
    result = join(result, next);
  }
  return result;
}

std::vector<Id> Reference::nodes(Id graph) const {
  std::set<Id> result;
  for (const Quad& quad : quads_) {
    if (quad.graph != graph) continue;
    result.insert(quad.subject);
    result.insert(quad.object);
  }
  return {result.begin(), result.end()};
}

// Section 18.4: pairs of ends; ends that are terms are given, others are the null Id.
std::vector<std::pair<Id, Id>> Reference::path(const syntax::Path& path, Id from, Id to, Id graph) {
  using Kind = syntax::Path::Kind;
  if (path.kind == Kind::kInverse) {
    auto result = this->path(path.parts[0], to, from, graph);
    for (auto& [a, b] : result) std::swap(a, b);
    return result;
  }
  if (path.kind == Kind::kSequence) {
    // X path1/path2 Y is the join of X path1 ?v and ?v path2 Y (section 18.2.2.4).
    auto result = this->path(path.parts[0], from, {}, graph);
    for (std::size_t i = 1; i < path.parts.size(); ++i) {
      const bool last = i + 1 == path.parts.size();
      const auto next = this->path(path.parts[i], {}, last ? to : Id{}, graph);
      std::vector<std::pair<Id, Id>> longer;
      for (const auto& [a, b] : result) {
        for (const auto& [c, d] : next) {
          if (b == c) longer.emplace_back(a, d);
        }
      }
      result = std::move(longer);
    }
    return result;
  }
  std::set<Id> starts;
  for (const Id node : nodes(graph)) starts.insert(node);
  // Terms that are given match paths of no steps even if they are in no triple.
  if (from) starts.insert(from);
  if (to) starts.insert(to);
  std::vector<std::pair<Id, Id>> result;
  for (const Id start : starts) {
    if (from && start != from) continue;
    for (const Id end : walk(path, start, graph)) {
      if (!to || end == to) result.emplace_back(start, end);
    }
  }
  return result;
}

// The nodes that the path reaches from here, as often as there are ways; of * + ? each once.
std::vector<Id> Reference::walk(const syntax::Path& path, Id from, Id graph) {
  using Kind = syntax::Path::Kind;
  std::vector<Id> result;
  const auto listed = [](const std::vector<Id>& list, Id id) {
    return std::find(list.begin(), list.end(), id) != list.end();
  };
  switch (path.kind) {
    case Kind::kIri:
      for (const Quad& quad : quads_) {
        if (quad.graph == graph && quad.predicate == path.iri && quad.subject == from) {
          result.push_back(quad.object);
        }
      }
      break;
    case Kind::kInverse: {
      // Whoever reaches this node.
      std::set<Id> all = {from};
      for (const Id node : nodes(graph)) all.insert(node);
      for (const Id start : all) {
        for (const Id end : walk(path.parts[0], start, graph)) {
          if (end == from) result.push_back(start);
        }
      }
      break;
    }
    case Kind::kSequence:
      result = {from};
      for (const syntax::Path& part : path.parts) {
        std::vector<Id> next;
        for (const Id at : result) {
          for (const Id end : walk(part, at, graph)) next.push_back(end);
        }
        result = std::move(next);
      }
      break;
    case Kind::kAlternative:
      for (const syntax::Path& part : path.parts) {
        for (const Id end : walk(part, from, graph)) result.push_back(end);
      }
      break;
    case Kind::kNegated:
      for (const Quad& quad : quads_) {
        if (quad.graph != graph) continue;
        if (path.walks_forward && quad.subject == from && !listed(path.forward, quad.predicate)) {
          result.push_back(quad.object);
        }
        if (path.walks_backward && quad.object == from && !listed(path.backward, quad.predicate)) {
          result.push_back(quad.subject);
        }
      }
      break;
    case Kind::kZeroOrOne:
    case Kind::kZeroOrMore:
    case Kind::kOneOrMore: {
      std::set<Id> seen;
      std::vector<Id> frontier = {from};
      if (path.kind != Kind::kOneOrMore) seen.insert(from);
      for (bool first = true; !frontier.empty() && (first || path.kind != Kind::kZeroOrOne);
           first = false) {
        std::vector<Id> next;
        for (const Id at : frontier) {
          for (const Id end : walk(path.parts[0], at, graph)) {
            if (seen.insert(end).second) next.push_back(end);
          }
        }
        frontier = std::move(next);
      }
      result.assign(seen.begin(), seen.end());
      break;
    }
  }
  return result;
}

Solutions Reference::select(const algebra::Select& select, Id graph, const Solution& constants) {
  Solutions solutions = evaluate(select.where, graph, constants);
  if (select.grouped) {
    std::map<std::vector<Id>, Solutions> groups;
    if (select.keys.empty()) groups[{}];
    for (const Solution& solution : solutions) {
      std::vector<Id> key;
      for (const auto& assignment : select.keys) {
        key.push_back(value(assignment.expression, solution, graph, constants));
      }
      groups[key].push_back(solution);
    }
    solutions.clear();
    for (const auto& [key, members] : groups) {
      Solution& solution = solutions.emplace_back();
      for (std::size_t i = 0; i < key.size(); ++i) {
        if (key[i]) solution[select.keys[i].variable] = key[i];
      }
      // COUNT is the only aggregate that is asked for.
      for (const algebra::Aggregate& aggregate : select.aggregates) {
        std::set<std::vector<Id>> distinct;
        std::int64_t count = 0;
        for (const Solution& member : members) {
          std::vector<Id> what;
          if (aggregate.argument) {
            what.push_back(value(*aggregate.argument, member, graph, constants));
            if (!what[0]) continue;
          } else {
            for (const auto& [variable, id] : member) {
              what.push_back(Id{variable});
              what.push_back(id);
            }
          }
          if (aggregate.distinct && !distinct.insert(what).second) continue;
          ++count;
        }
        solution[aggregate.result] = values::term_of(Value::of_integer(count), space_);
      }
    }
  }
  Solutions kept;
  for (const Solution& solution : solutions) {
    if (holds(select.having, solution, graph, constants)) kept.push_back(solution);
  }
  Solutions result;
  std::set<Solution> seen;
  for (Solution& solution : kept) {
    for (const auto& assignment : select.assignments) {
      if (const Id id = value(assignment.expression, solution, graph, constants)) {
        solution[assignment.variable] = id;
      }
    }
    Solution projected;
    for (const Variable column : select.columns) {
      const auto found = solution.find(column);
      if (found != solution.end()) projected.insert(*found);
    }
    if (select.distinct && !seen.insert(projected).second) continue;
    result.push_back(projected);
  }
  return result;
}

bool Reference::holds(const std::vector<Expression>& conditions, const Solution& solution, Id graph,
                      const Solution& constants) {
  return std::all_of(conditions.begin(), conditions.end(), [&](const Expression& condition) {
    const Id id = value(condition, solution, graph, constants);
    return values::truth_of(values::value_of(id, space_)) == Truth::kTrue;
  });
}

Id Reference::value(const Expression& expression, const Solution& solution, Id graph,
                    const Solution& constants) {
  const auto term = [&](std::size_t i) {
    return value(expression.arguments[i], solution, graph, constants);
  };
  const auto argument = [&](std::size_t i) { return values::value_of(term(i), space_); };
  const auto boolean = [&](Truth truth) {
    return values::term_of(values::value_of(truth), space_);
  };
  const auto lookup = [&](Variable variable) -> Id {
    const auto found = solution.find(variable);
    if (found != solution.end()) return found->second;
    const auto constant = constants.find(variable);
    return constant == constants.end() ? Id{} : constant->second;
  };
  switch (expression.op) {
    case Operator::kConstant:
      return expression.term;
    case Operator::kVariable:
      return lookup(expression.variable);
    case Operator::kBound:
      return boolean(values::truth(static_cast<bool>(lookup(expression.variable))));
    case Operator::kNot: {
      const Truth inner = values::truth_of(argument(0));
      return boolean(inner == Truth::kError ? inner : values::truth(inner == Truth::kFalse));
    }
    case Operator::kAnd:
    case Operator::kOr: {
      const Truth wins = expression.op == Operator::kAnd ? Truth::kFalse : Truth::kTrue;
      Truth result = expression.op == Operator::kAnd ? Truth::kTrue : Truth::kFalse;
      for (std::size_t i = 0; i < expression.arguments.size(); ++i) {
        const Truth part = values::truth_of(argument(i));
        if (part == wins) return boolean(part);
        if (part == Truth::kError) result = part;
      }
      return boolean(result);
    }
    case Operator::kEqual:
      return boolean(values::equals(argument(0), argument(1), space_));
    case Operator::kNotEqual: {
      const Truth same = values::equals(argument(0), argument(1), space_);
      return boolean(same == Truth::kError ? same : values::truth(same == Truth::kFalse));
    }
    case Operator::kLess:
      return boolean(values::less(argument(0), argument(1)));
    case Operator::kAdd:
      return values::term_of(values::arithmetic(expression.op, argument(0), argument(1)), space_);
    case Operator::kCoalesce:
      for (std::size_t i = 0; i < expression.arguments.size(); ++i) {
        if (const Id id = term(i)) return id;
      }
      return {};
    case Operator::kExists:
    case Operator::kNotExists: {
      const Solution around = merge(solution, constants);
      const bool found = !evaluate(*expression.pattern, graph, around).empty();
      return boolean(values::truth(found == (expression.op == Operator::kExists)));
    }
    default:
      throw std::logic_error("the reference does not know this operator");
  }
}

}  // namespace sinew::rdf::sparql::reference
