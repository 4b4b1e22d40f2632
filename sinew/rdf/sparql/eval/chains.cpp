// Closures over a chain of properties, (^a/b/c)+, which most recursive queries of models are. What
// paths.cpp does for every path is done here without calls in between: one step is a hash lookup,
// one triple for each node that it leads to, and one memory cell that says whether the node is new.
#include "sinew/graph/packed.h"
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
  if (step.kind == PathStep::Kind::kZeroOrMore) {
    memory.reach(from, count - 1);
    if (!visit(from)) return false;
  }
  memory.queues[0].push_if(true, from);
  const graph::Steps steps(view_);
  std::array<const graph::Adjacency*, plan::kMaxChain> packed = {};
  if (const graph::Packed* const all = view_.packed()) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const PathStep& property = plan_->paths.steps[chain[i]];
      packed[i] = all->find(property.iri, plan::direction_of(property));
    }
  }
  // Calls arrive for each node behind the property; false when it stopped.
  const auto go = [&](std::uint32_t i, Id node, auto&& arrive) {
    if (packed[i]) {
      for (const Id reached : packed[i]->of(node)) {
        if (!arrive(reached)) return false;
      }
      return true;
    }
    const PathStep& property = plan_->paths.steps[chain[i]];
    return property.inverse ? steps.subjects(property.iri, node, arrive)
                            : steps.objects(node, property.iri, arrive);
  };

  // From queue to queue, and from the last property to the first queue again.
  const std::uint32_t last = count - 1;
  while (!memory.queues[0].empty()) {
    for (std::uint32_t i = 0; i < last; ++i) {
      ChainQueue& queue = memory.queues[i];
      ChainQueue& next = memory.queues[i + 1];
      const std::size_t before = next.size();
      while (!queue.empty()) {
        go(i, queue.take(), [&](Id node) {
          next.push_if(memory.reach(node, i), node);
          return true;
        });
      }
      count_path_steps(next.size() - before);
    }
    while (!memory.queues[last].empty()) {
      const bool go_on = go(last, memory.queues[last].take(), [&](Id node) {
        if (!memory.reach(node, last)) return true;
        count_path_steps(1);
        // From the first node the walk has gone on already.
        memory.queues[0].push_if(node != from, node);
        return visit(node);
      });
      if (!go_on) return false;
    }
  }
  return true;
}

}  // namespace sinew::rdf::sparql::eval
