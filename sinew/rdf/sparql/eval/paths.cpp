// Property paths (SPARQL 1.1, section 18.4), walked from the end that is known.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/rdf/sparql/eval/matching.h"
#include "sinew/rdf/sparql/eval/state.h"

namespace sinew::rdf::sparql::eval {

using plan::GraphKind;
using plan::Op;
using plan::PathStep;
using Kind = PathStep::Kind;

bool Evaluator::match_path(const Op& op) {
  tick();
  if (op.graph_kind == GraphKind::kDefault || slots_[op.graph]) return path_in_graph(op);
  // GRAPH ?g: one graph after the other.
  const auto visit = [&](Id graph) {
    slots_[op.graph] = graph;
    return path_in_graph(op);
  };
  bool go_on = true;
  if (plan_->dataset.named_restricted) {
    go_on = std::all_of(plan_->dataset.named.begin(), plan_->dataset.named.end(), visit);
  } else {
    go_on = view_.named_graphs(visit);
  }
  slots_[op.graph] = {};
  return go_on;
}

bool Evaluator::path_in_graph(const Op& op) {
  const plan::PathRoots& roots = plan_->path_roots[op.item];
  path_graph_kind_ = op.graph_kind;
  path_graph_ = op.graph;
  const Id subject = slots_[op.subject];
  const Id object = slots_[op.object];
  if (!subject && !object) return path_from_everywhere(op);
  // A term that is bound elsewhere and is in no triple: not even a path of no steps matches it.
  if (op.nodes_only && plan_->paths.steps[roots.forward].matches_zero &&
      !is_node(subject ? subject : object)) {
    return true;
  }
  if (subject && object) {
    const Kind kind = plan_->paths.steps[roots.forward].kind;
    const bool at_most_once =
        kind == Kind::kZeroOrMore || kind == Kind::kOneOrMore || kind == Kind::kZeroOrOne;
    bool go_on = true;
    walk(roots.forward, subject, [&](Id reached) {
      if (reached != object) return true;
      go_on = run(op.next);
      path_graph_kind_ = op.graph_kind;
      path_graph_ = op.graph;
      return go_on && !at_most_once;
    });
    return go_on;
  }
  const bool backward = !subject;
  const Slot target = backward ? op.subject : op.object;
  const bool go_on =
      walk(backward ? roots.backward : roots.forward, backward ? object : subject, [&](Id reached) {
        slots_[target] = reached;
        const bool more = run(op.next);
        // What ran may have walked a path in another graph.
        path_graph_kind_ = op.graph_kind;
        path_graph_ = op.graph;
        return more;
      });
  slots_[target] = {};
  return go_on;
}

bool Evaluator::path_from_everywhere(const Op& op) {
  const plan::PathRoots& roots = plan_->path_roots[op.item];
  VisitedSet& starts = visited_[roots.starts];
  starts.begin();
  find_starts(roots.forward, starts);
  bool go_on = true;
  for (std::size_t i = 0; go_on && i < starts.queue.size(); ++i) {
    slots_[op.subject] = starts.queue[i];
    go_on = path_in_graph(op);  // ?x path ?x has both ends now
  }
  slots_[op.subject] = {};
  return go_on;
}

bool Evaluator::is_node(Id id) {
  const auto found = [](const graph::Quad&) { return false; };
  return !match(path_graph_kind_, path_graph_, id, {}, {}, found) ||
         !match(path_graph_kind_, path_graph_, {}, {}, id, found);
}

// Every node from which the path could begin.
void Evaluator::find_starts(std::uint32_t step_index, VisitedSet& into) {
  const auto add = [&](Id id) {
    if (into.insert(id)) {
      into.queue.push_back(id);
      count_path_step();
    }
  };
  const PathStep& step = plan_->paths.steps[step_index];
  if (!step.matches_zero) {
    switch (step.kind) {
      case Kind::kIri:
        match(path_graph_kind_, path_graph_, {}, step.iri, {}, [&](const graph::Quad& quad) {
          add(step.inverse ? quad.object : quad.subject);
          return true;
        });
        return;
      case Kind::kOneOrMore:
      case Kind::kSequence:
        // A sequence's first part may match zero steps; then all nodes are starts, as below.
        find_starts(plan_->paths.parts[step.first_part], into);
        return;
      case Kind::kAlternative:
        for (std::uint32_t i = 0; i < step.part_count; ++i) {
          find_starts(plan_->paths.parts[step.first_part + i], into);
        }
        return;
      default:
        break;
    }
  }
  match(path_graph_kind_, path_graph_, {}, {}, {}, [&](const graph::Quad& quad) {
    add(quad.subject);
    add(quad.object);
    return true;
  });
}

void Evaluator::fail_long_path() const {
  fail(fmt::format("paths reach more than {} nodes", limits_.path_steps),
       "give one end of the path a value, or raise Limits::path_steps");
}

// Calls visit for each node that the path reaches from `from`. False when visit stopped it.
bool Evaluator::walk(std::uint32_t step_index, Id from, NodeVisitor visit) {
  const PathStep& step = plan_->paths.steps[step_index];
  switch (step.kind) {
    case Kind::kIri:
      if (step.inverse) {
        return match(path_graph_kind_, path_graph_, {}, step.iri, from,
                     [&](const graph::Quad& quad) { return visit(quad.subject); });
      }
      return match(path_graph_kind_, path_graph_, from, step.iri, {},
                   [&](const graph::Quad& quad) { return visit(quad.object); });
    case Kind::kSequence:
      return walk_sequence(step, 0, from, visit);
    case Kind::kAlternative:
      for (std::uint32_t i = 0; i < step.part_count; ++i) {
        if (!walk(plan_->paths.parts[step.first_part + i], from, visit)) return false;
      }
      return true;
    case Kind::kZeroOrMore:
    case Kind::kOneOrMore:
    case Kind::kZeroOrOne:
      return can_walk_chain(step) ? walk_chain(step, from, visit) : walk_closure(step, from, visit);
    case Kind::kNegated:
      return walk_negated(step, from, visit);
    case Kind::kInverse:
      break;  // compiled away
  }
  return true;
}

bool Evaluator::walk_sequence(const PathStep& step, std::uint32_t part, Id from,
                              NodeVisitor visit) {
  const std::uint32_t inner = plan_->paths.parts[step.first_part + part];
  if (part + 1 == step.part_count) return walk(inner, from, visit);
  return walk(inner, from, [&](Id middle) {
    if (step.each_middle_once) {
      if (!visited_[step.visited + part].insert(middle)) return true;
      count_path_step();
    }
    return walk_sequence(step, part + 1, middle, visit);
  });
}

// Breadth first; each node once.
bool Evaluator::walk_closure(const PathStep& step, Id from, NodeVisitor visit) {
  VisitedSet& reached = visited_[step.visited];
  reached.begin();
  for (std::uint32_t i = 0; i < step.middle_count; ++i) visited_[step.first_middle + i].begin();
  const std::uint32_t inner = plan_->paths.parts[step.first_part];
  if (step.kind != Kind::kOneOrMore) {
    reached.insert(from);
    if (!visit(from)) return false;
  }
  const auto arrive = [&](Id node) {
    if (!reached.insert(node)) return true;
    count_path_step();
    // From the first node the walk has gone on already.
    if (node != from) reached.queue.push_back(node);
    return visit(node);
  };
  if (!walk(inner, from, arrive)) return false;
  if (step.kind == Kind::kZeroOrOne) return true;
  for (std::size_t i = 0; i < reached.queue.size(); ++i) {
    if (!walk(inner, reached.queue[i], arrive)) return false;
  }
  return true;
}

bool Evaluator::walk_negated(const PathStep& step, Id from, NodeVisitor visit) {
  const auto listed = [](const std::vector<Id>& list, Id id) {
    return std::find(list.begin(), list.end(), id) != list.end();
  };
  if (step.walks_forward) {
    const bool go_on =
        match(path_graph_kind_, path_graph_, from, {}, {}, [&](const graph::Quad& quad) {
          return listed(step.forward, quad.predicate) || visit(quad.object);
        });
    if (!go_on) return false;
  }
  return !step.walks_backward ||
         match(path_graph_kind_, path_graph_, {}, {}, from, [&](const graph::Quad& quad) {
           return listed(step.backward, quad.predicate) || visit(quad.subject);
         });
}

}  // namespace sinew::rdf::sparql::eval
