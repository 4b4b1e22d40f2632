// The graph under the world beside libcgraph, the library that the source's property graph was
// built on: inserting nodes with an edge each, visiting every node's edges. Names are made
// beforehand; closing what was made is part of inserting it. Each side names its nodes; edges have
// names in the world and in BM_cgraph_insert_named. What is visited is compared before it is timed.
#include <benchmark/benchmark.h>
#ifdef SINEW_HAVE_CGRAPH
#include <graphviz/cgraph.h>
#endif

#include <algorithm>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/world/edit.h"
#include "sinew/world/links.h"
#include "sinew/world/world.h"

namespace {

using namespace sinew;

constexpr int kNodes = 10'000;

// Node i is linked to an earlier one.
struct Names {
  Names() {
    std::mt19937 random(5);
    for (int i = 0; i < kNodes; ++i) {
      nodes.push_back("http://bench/node" + std::to_string(i));
      edges.push_back("http://bench/edge" + std::to_string(i));
      parents.push_back(i == 0 ? 0 : random() % static_cast<unsigned>(i));
    }
  }
  std::vector<std::string> nodes, edges;
  std::vector<std::size_t> parents;
};
const Names& names() {
  static const Names made;
  return made;
}

void count(benchmark::State& state) { state.SetItemsProcessed(state.iterations() * kNodes); }

// ---- the quad store: a triple for each edge ----

struct Inserted {
  graph::Store store;
  std::vector<graph::Id> nodes;
  graph::Id linked = store.terms().iri("http://bench/linked");
  Inserted() {
    nodes.reserve(kNodes);
    graph::Transaction transaction = store.begin();
    for (std::size_t i = 0; i < kNodes; ++i) {
      nodes.push_back(store.terms().iri(names().nodes[i]));
      transaction.add({nodes[i], linked, nodes[names().parents[i]], {}});
    }
    transaction.commit();
  }
};

void BM_insert_graph(benchmark::State& state) {
  names();
  for (auto _ : state) {
    const auto made = std::make_unique<Inserted>();
    benchmark::DoNotOptimize(made->nodes.data());
  }
  count(state);
}
BENCHMARK(BM_insert_graph)->Unit(benchmark::kMicrosecond);

// From every node to those that it is linked to, by the edges that the store keeps packed.
void BM_visit_graph(benchmark::State& state) {
  const Inserted made;
  for (auto _ : state) {
    const auto links = made.store.edges(made.linked, graph::Direction::kOut);
    std::uint64_t sum = 0;
    links->visit([&](graph::Id, std::span<const graph::Id> linked_to) {
      for (const graph::Id id : linked_to) sum += id.value;
    });
    benchmark::DoNotOptimize(sum);
  }
  count(state);
}
BENCHMARK(BM_visit_graph)->Unit(benchmark::kMicrosecond);

// The same with a look-up for each node.
void BM_visit_graph_by_look_up(benchmark::State& state) {
  const Inserted made;
  const graph::Snapshot snapshot = made.store.snapshot();
  for (auto _ : state) {
    std::uint64_t sum = 0;
    for (const graph::Id node : made.nodes) {
      snapshot.match(node, made.linked, {}, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
        sum += quad.object.value;
        return true;
      });
    }
    benchmark::DoNotOptimize(sum);
  }
  count(state);
}
BENCHMARK(BM_visit_graph_by_look_up)->Unit(benchmark::kMicrosecond);

// What the first one after a commit has to do before.
void BM_pack_graph(benchmark::State& state) {
  const Inserted made;
  const graph::Snapshot snapshot = made.store.snapshot();
  for (auto _ : state) {
    const graph::Adjacency links(snapshot, made.linked, graph::Direction::kOut);
    benchmark::DoNotOptimize(links.size());
  }
  count(state);
}
BENCHMARK(BM_pack_graph)->Unit(benchmark::kMicrosecond);

// All edges, whatever their node.
void BM_visit_all_graph(benchmark::State& state) {
  const Inserted made;
  const graph::Snapshot snapshot = made.store.snapshot();
  for (auto _ : state) {
    std::uint64_t sum = 0;
    snapshot.match({}, {}, {}, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
      sum += quad.object.value;
      return true;
    });
    benchmark::DoNotOptimize(sum);
  }
  count(state);
}
BENCHMARK(BM_visit_all_graph)->Unit(benchmark::kMicrosecond);

// ---- the world: a frame and a named relation for each node ----

std::unique_ptr<world::World> world_of_names() {
  auto made = std::make_unique<world::World>();
  world::Edit edit = made->edit();
  std::vector<world::FrameId> frames;
  frames.reserve(kNodes);
  for (std::size_t i = 0; i < kNodes; ++i) {
    frames.push_back(edit.add_frame(names().nodes[i]));
    if (i == 0) continue;
    edit.add_relation(
        {.name = names().edges[i], .of = frames[i], .with_respect_to = frames[names().parents[i]]});
  }
  edit.commit();
  return made;
}

void BM_insert_world(benchmark::State& state) {
  names();
  for (auto _ : state) benchmark::DoNotOptimize(world_of_names());
  count(state);
}
BENCHMARK(BM_insert_world)->Unit(benchmark::kMicrosecond);

// From every frame to those that relations link it with, by the links that the world keeps packed.
void BM_visit_world(benchmark::State& state) {
  const auto made = world_of_names();
  for (auto _ : state) {
    const auto links = made->links();
    std::uint64_t sum = 0;
    for (world::Index frame = 0; frame < links->frames(); ++frame) {
      for (const world::Link link : links->of(frame)) sum += link.other;
    }
    benchmark::DoNotOptimize(sum);
  }
  count(state);
}
BENCHMARK(BM_visit_world)->Unit(benchmark::kMicrosecond);

// The same over each frame's list of relations.
void BM_visit_world_by_lists(benchmark::State& state) {
  const auto made = world_of_names();
  const world::State now = made->state();
  for (auto _ : state) {
    std::uint64_t sum = 0;
    for (world::Index frame = 0; frame < now.frames.size(); ++frame) {
      for (world::Index at = now.frames[frame].first_relation; at != world::kNone;) {
        const world::RelationRecord& relation = now.relations[at];
        sum += relation.with_respect_to;
        at = relation.of == frame ? relation.next_at_of : relation.next_at_with_respect_to;
      }
    }
    benchmark::DoNotOptimize(sum);
  }
  count(state);
}
BENCHMARK(BM_visit_world_by_lists)->Unit(benchmark::kMicrosecond);

void BM_pack_world(benchmark::State& state) {
  const auto made = world_of_names();
  const world::State now = made->state();
  for (auto _ : state) {
    const world::Links links(now);
    benchmark::DoNotOptimize(links.size());
  }
  count(state);
}
BENCHMARK(BM_pack_world)->Unit(benchmark::kMicrosecond);

#ifdef SINEW_HAVE_CGRAPH
// ---- libcgraph ----

Agraph_t* cgraph_of_names(bool name_edges = false) {
  Agraph_t* const graph = agopen(const_cast<char*>("bench"), Agdirected, nullptr);
  std::vector<Agnode_t*> nodes;
  nodes.reserve(kNodes);
  for (std::size_t i = 0; i < kNodes; ++i) {
    nodes.push_back(agnode(graph, const_cast<char*>(names().nodes[i].c_str()), 1));
    char* const edge = name_edges ? const_cast<char*>(names().edges[i].c_str()) : nullptr;
    agedge(graph, nodes[i], nodes[names().parents[i]], edge, 1);
  }
  return graph;
}

void BM_cgraph_insert(benchmark::State& state) {
  names();
  for (auto _ : state) agclose(cgraph_of_names());
  count(state);
}
BENCHMARK(BM_cgraph_insert)->Unit(benchmark::kMicrosecond);

void BM_cgraph_insert_named(benchmark::State& state) {
  names();
  for (auto _ : state) agclose(cgraph_of_names(true));
  count(state);
}
BENCHMARK(BM_cgraph_insert_named)->Unit(benchmark::kMicrosecond);

// Whether all sides link the same nodes, by their names; each pair of a node and what it is linked
// to, and for the world, which knows no loop at the first node and links both ways, both.
bool same_links(Agraph_t* theirs) {
  using Pairs = std::vector<std::pair<std::string, std::string>>;
  const auto sorted = [](Pairs pairs) {
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  };
  Pairs expected, expected_both, listed, packed, of_world;
  for (Agnode_t* node = agfstnode(theirs); node; node = agnxtnode(theirs, node)) {
    for (Agedge_t* edge = agfstout(theirs, node); edge; edge = agnxtout(theirs, edge)) {
      expected.emplace_back(agnameof(node), agnameof(aghead(edge)));
      if (node == aghead(edge)) continue;
      expected_both.emplace_back(agnameof(node), agnameof(aghead(edge)));
      expected_both.emplace_back(agnameof(aghead(edge)), agnameof(node));
    }
  }
  const Inserted made;
  const graph::Terms& terms = made.store.terms();
  const graph::Snapshot snapshot = made.store.snapshot();
  snapshot.match({}, made.linked, {}, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
    listed.emplace_back(terms.text(quad.subject), terms.text(quad.object));
    return true;
  });
  made.store.edges(made.linked, graph::Direction::kOut)
      ->visit([&](graph::Id node, std::span<const graph::Id> linked_to) {
        for (const graph::Id id : linked_to) packed.emplace_back(terms.text(node), terms.text(id));
      });
  const auto world = world_of_names();
  const auto links = world->links();
  for (world::Index frame = 0; frame < links->frames(); ++frame) {
    for (const world::Link link : links->of(frame)) {
      of_world.emplace_back(names().nodes[frame], names().nodes[link.other]);
    }
  }
  expected = sorted(std::move(expected));
  return expected.size() == kNodes && sorted(std::move(listed)) == expected &&
         sorted(std::move(packed)) == expected &&
         sorted(std::move(of_world)) == sorted(std::move(expected_both));
}

void BM_cgraph_visit(benchmark::State& state) {
  Agraph_t* const graph = cgraph_of_names();
  if (!same_links(graph)) state.SkipWithError("what is visited differs");
  for (auto _ : state) {
    std::uint64_t sum = 0;
    for (Agnode_t* node = agfstnode(graph); node; node = agnxtnode(graph, node)) {
      for (Agedge_t* edge = agfstout(graph, node); edge; edge = agnxtout(graph, edge)) {
        sum += AGID(aghead(edge));
      }
    }
    benchmark::DoNotOptimize(sum);
  }
  count(state);
  agclose(graph);
}
BENCHMARK(BM_cgraph_visit)->Unit(benchmark::kMicrosecond);
#endif

}  // namespace
