// Closures over a chain of properties, (^a/b/c)+, which most recursive queries of models are. What
// paths.cpp does for every path is done here without calls in between: one step is a hash lookup,
// one triple for each node that it leads to, and one memory cell that says whether the node is new.
// What a node leads to over the whole chain is remembered (chain_lists.h).
#include <array>

#include "sinew/rdf/sparql/eval/state.h"

namespace sinew::rdf::sparql::eval {

using plan::PathStep;

namespace {

// A cell for each term is worth its memory up to here: 4 MB.
constexpr std::size_t kMaxTerms = std::size_t{1} << 20;

}  // namespace

bool Evaluator::can_walk_chain(const PathStep& step) const {
  return step.chain != plan::kNoChain && path_graph_kind_ == plan::GraphKind::kDefault &&
         plan_->dataset.kind == plan::DatasetPlan::Default::kUnion &&
         view_.terms().size() <= kMaxTerms;
}

bool Evaluator::walk_chain(const PathStep& step, Id from, NodeVisitor visit) {
  if (values::is_local(from)) {  // which is in no triple
    return step.kind == PathStep::Kind::kOneOrMore || visit(from);
  }
  const std::span<const std::uint32_t> chain = plan::chain_of(step, plan_->paths);
  const auto count = static_cast<std::uint32_t>(chain.size());

  ChainMemory& memory = chains_[step.chain];
  memory.begin(view_.terms().size());
  memory.lists.begin(view_.terms().size(), view_.stamp());
  const std::uint32_t last = count - 1;
  if (step.kind == PathStep::Kind::kZeroOrMore) {
    memory.reach(from, last);
    if (!visit(from)) return false;
  }
  const graph::Steps steps(view_);
  // Calls arrive for each node behind the property; false when it stopped.
  const auto go = [&](std::uint32_t i, Id node, auto&& arrive) {
    const PathStep& property = plan_->paths.steps[chain[i]];
    return property.inverse ? steps.subjects(property.iri, node, arrive)
                            : steps.objects(node, property.iri, arrive);
  };
  // At a node behind the whole chain.
  const auto arrive = [&](Id node) {
    if (!memory.reach(node, last)) return true;
    count_path_steps(1);
    // From the first node the walk has gone on already.
    memory.queues[0].push_if(node != from, node);
    return visit(node);
  };

  // From queue to queue, node by node. What an earlier node has led to in between leads nowhere
  // new; so all nodes are come to in the same order, whatever is remembered.
  const auto walk_on = [&](Id first) {
    if (last == 0) return go(0, first, arrive);
    for (std::uint32_t i = 0; i < last; ++i) {
      ChainQueue& next = memory.queues[i + 1];
      const std::size_t before = next.size();
      const auto push = [&](Id node) {
        next.push_if(memory.reach(node, i), node);
        return true;
      };
      if (i == 0) {
        go(0, first, push);
      } else {
        while (!memory.queues[i].empty()) go(i, memory.queues[i].take(), push);
      }
      count_path_steps(next.size() - before);
    }
    while (!memory.queues[last].empty()) {
      if (!go(last, memory.queues[last].take(), arrive)) return false;
    }
    return true;
  };
  // Remembers what the node leads to; false where that is too much.
  const auto learn = [&](Id node, std::span<const Id>& list) {
    std::array<Id, ChainLists::kMostNodes> here = {node}, there;
    std::size_t here_count = 1, ways = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      std::size_t there_count = 0;
      const auto take = [&](Id reached) {
        if (++ways > ChainLists::kMostWays) return false;
        for (std::size_t at = 0; at < there_count; ++at) {
          if (there[at] == reached) return true;
        }
        if (there_count == there.size()) return false;
        there[there_count++] = reached;
        return true;
      };
      for (std::size_t at = 0; at < here_count; ++at) {
        if (go(i, here[at], take)) continue;
        memory.lists.remember_too_long(node);
        return false;
      }
      if (i < last) count_path_steps(there_count);
      std::swap(here, there);
      here_count = there_count;
    }
    list = memory.lists.remember(node, {here.data(), here_count});
    return true;
  };

  memory.queues[0].push_if(true, from);
  while (!memory.queues[0].empty()) {
    const Id node = memory.queues[0].take();
    std::span<const Id> list;
    const ChainLists::Known known = memory.lists.find(node, list);
    if (known == ChainLists::Known::kList ||
        (known == ChainLists::Known::kNothing && learn(node, list))) {
      for (const Id reached : list) {
        if (!arrive(reached)) return false;
      }
    } else if (!walk_on(node)) {
      return false;
    }
  }
  return true;
}

}  // namespace sinew::rdf::sparql::eval
