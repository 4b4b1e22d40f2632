// What the graph's operations cost. Sizes are those of one robot's models (1,330 triples), of its
// synthesised algorithm (4,448), of a larger robot (10,640), and of a world (1,000,000).
#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/graph/traversal.h"

namespace sinew::graph {
namespace {

// Triples shaped like a model's: some four per subject, few predicates, objects that are shared.
struct Data {
  Store store;
  std::vector<Id> predicates;
  std::vector<Quad> quads;

  explicit Data(std::size_t size) {
    std::mt19937 random(7);
    Terms& terms = store.terms();
    for (int i = 0; i < 40; ++i) predicates.push_back(terms.iri("http://x/p" + std::to_string(i)));
    std::vector<Id> nodes;
    for (std::size_t i = 0; i < size / 4 + 8; ++i) {
      nodes.push_back(terms.iri("http://example.org/robot/model#node" + std::to_string(i)));
    }
    const auto any = [&](const std::vector<Id>& from) { return from[random() % from.size()]; };
    while (quads.size() < size) {
      const Quad quad{nodes[quads.size() / 4], any(predicates), any(nodes), any(predicates)};
      quads.push_back(quad);
    }
  }
  void fill() {
    Transaction transaction = store.begin();
    for (const Quad& quad : quads) transaction.add(quad);
    transaction.commit();
  }
};

void per_item(benchmark::State& state, std::size_t items) {
  state.counters["per_item"] =
      benchmark::Counter(static_cast<double>(items), benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int size : {1'330, 4'448, 10'640, 100'000, 1'000'000}) benchmark->Arg(size);
}
void model_sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int size : {1'330, 4'448, 10'640}) benchmark->Arg(size);
}

// Into a new store of a process that had stores before.
template <typename Add>
void insert(benchmark::State& state, Add&& add) {
  const auto data = std::make_unique<Data>(state.range(0));
  for (auto _ : state) {
    state.PauseTiming();
    Store store = data->store.clone();
    state.ResumeTiming();
    Transaction transaction = store.begin();
    add(transaction, data->quads);
    transaction.commit();
    state.PauseTiming();
    { const Store gone = std::move(store); }
    state.ResumeTiming();
  }
  per_item(state, data->quads.size());
}
void BM_Insert(benchmark::State& state) {
  insert(state, [](Transaction& transaction, const std::vector<Quad>& quads) {
    for (const Quad& quad : quads) transaction.add(quad);
  });
}
BENCHMARK(BM_Insert)->Apply(sizes);

void BM_InsertAtOnce(benchmark::State& state) {
  insert(state,
         [](Transaction& transaction, const std::vector<Quad>& quads) { transaction.add(quads); });
}
BENCHMARK(BM_InsertAtOnce)->Apply(sizes);

// A search step: add some triples, take them back.
void BM_AddAndUndo(benchmark::State& state) {
  Data data(10'640);
  data.fill();
  Transaction transaction = data.store.begin();
  std::vector<Quad> step;
  for (int i = 0; i < 100; ++i) {
    step.push_back({data.quads[i * 100].subject, data.predicates[i % 40], data.predicates[i / 40]});
  }
  for (auto _ : state) {
    const auto mark = transaction.mark();
    for (const Quad& quad : step) benchmark::DoNotOptimize(transaction.add(quad));
    transaction.undo_to(mark);
  }
  per_item(state, step.size());
}
BENCHMARK(BM_AddAndUndo);

// Only the taking back, measured as the difference of many at once.
void BM_Undo(benchmark::State& state) {
  Data data(10'640);
  for (auto _ : state) {
    state.PauseTiming();
    std::optional<Transaction> transaction(data.store.begin());
    for (const Quad& quad : data.quads) transaction->add(quad);
    state.ResumeTiming();
    transaction->undo_to(0);
    state.PauseTiming();
    transaction.reset();
    state.ResumeTiming();
  }
  per_item(state, data.quads.size());
}
BENCHMARK(BM_Undo);

// A question about one triple after the other, of a filled store seen in one way.
template <typename See, typename Ask>
void ask_in_turn(benchmark::State& state, See&& see, Ask&& ask) {
  Data data(state.range(0));
  data.fill();
  const auto view = see(data.store);
  std::size_t at = 0, seen = 0;
  for (auto _ : state) seen += ask(view, data.quads[(at += 17) % data.quads.size()]);
  benchmark::DoNotOptimize(seen);
}
constexpr auto kView = [](Store& store) { return store.view(); };
constexpr auto kSnapshot = [](Store& store) { return store.snapshot(); };

// The objects of a subject and predicate.
constexpr auto kObjects = [](const auto& view, const Quad& quad) {
  std::size_t seen = 0;
  view.match(quad.subject, quad.predicate, {}, Dataset::kUnion,
             [&](const Quad& found) { return seen += found.object.value, true; });
  return seen;
};
void BM_MatchObjects(benchmark::State& state) { ask_in_turn(state, kView, kObjects); }
BENCHMARK(BM_MatchObjects)->Apply(sizes);

void BM_MatchObjectsOfSnapshot(benchmark::State& state) { ask_in_turn(state, kSnapshot, kObjects); }
BENCHMARK(BM_MatchObjectsOfSnapshot)->Apply(sizes);

void BM_MatchInNamedGraph(benchmark::State& state) {
  ask_in_turn(state, kView, [](const View& view, const Quad& quad) {
    std::size_t seen = 0;
    view.match_in(quad.subject, quad.predicate, {}, quad.graph,
                  [&](const Quad& found) { return seen += found.object.value, true; });
    return seen;
  });
}
BENCHMARK(BM_MatchInNamedGraph)->Apply(model_sizes);

void BM_Contains(benchmark::State& state) {
  ask_in_turn(state, kView, [](const View& view, const Quad& quad) {
    return view.contains(quad.subject, quad.predicate, quad.object);
  });
}
BENCHMARK(BM_Contains)->Apply(sizes);

// All triples of one predicate: per triple.
void BM_ScanPredicate(benchmark::State& state) {
  Data data(state.range(0));
  data.fill();
  const View view = data.store.view();
  std::size_t seen = 0;
  const std::size_t length = view.estimate({}, data.predicates[3], {});
  for (auto _ : state) {
    view.match({}, data.predicates[3], {}, Dataset::kUnion,
               [&](const Quad& found) { return seen += found.object.value, true; });
  }
  benchmark::DoNotOptimize(seen);
  per_item(state, length);
}
BENCHMARK(BM_ScanPredicate)->Apply(sizes);

void BM_Snapshot(benchmark::State& state) {
  Data data(state.range(0));
  data.fill();
  for (auto _ : state) benchmark::DoNotOptimize(data.store.snapshot());
}
BENCHMARK(BM_Snapshot)->Apply(sizes);

void BM_Clone(benchmark::State& state) {
  Data data(state.range(0));
  data.fill();
  for (auto _ : state) benchmark::DoNotOptimize(data.store.clone());
}
BENCHMARK(BM_Clone)->Apply(model_sizes)->Unit(benchmark::kMicrosecond);

// One value of one property replaced: a transaction with a removal and an addition.
void BM_ReplaceValue(benchmark::State& state) {
  Data data(10'640);
  data.fill();
  std::vector<Id> values;
  for (int i = 0; i < 64; ++i) values.push_back(data.store.terms().integer(i));
  const Id subject = data.quads[0].subject, predicate = data.store.terms().iri("http://x/value");
  data.store.add({subject, predicate, values[0]});
  std::size_t at = 0;
  for (auto _ : state) {
    Transaction transaction = data.store.begin();
    transaction.remove({subject, predicate, values[at % 64]});
    transaction.add({subject, predicate, values[++at % 64]});
    transaction.commit();
  }
}
BENCHMARK(BM_ReplaceValue);

void BM_InternKnownIri(benchmark::State& state) {
  Data data(10'640);
  std::vector<std::string> texts;
  for (int i = 0; i < 64; ++i)
    texts.emplace_back(data.store.terms().text(data.quads[i * 4].subject));
  std::size_t at = 0;
  for (auto _ : state) benchmark::DoNotOptimize(data.store.terms().iri(texts[++at % 64]));
}
BENCHMARK(BM_InternKnownIri);

void BM_InternNewIri(benchmark::State& state) {
  std::vector<std::string> texts;
  for (int i = 0; i < 10'000; ++i) {
    texts.push_back("http://example.org/robot/model#other" + std::to_string(i));
  }
  for (auto _ : state) {
    Terms terms;
    for (const std::string& text : texts) benchmark::DoNotOptimize(terms.iri(text));
  }
  per_item(state, texts.size());
}
BENCHMARK(BM_InternNewIri);

void BM_DerivedNew(benchmark::State& state) {
  for (auto _ : state) {
    Terms terms;
    const Id role = terms.iri("http://x/pose");
    for (std::uint32_t i = 1; i <= 10'000; ++i) {
      benchmark::DoNotOptimize(terms.derived(role, {role, Id{i}}));
    }
  }
  per_item(state, 10'000);
}
BENCHMARK(BM_DerivedNew);

void BM_DerivedKnown(benchmark::State& state) {
  Terms terms;
  const Id role = terms.iri("http://x/pose"), other = terms.iri("http://x/other");
  for (auto _ : state) benchmark::DoNotOptimize(terms.derived(role, {role, other}));
}
BENCHMARK(BM_DerivedKnown);

void BM_DerivedText(benchmark::State& state) {
  for (auto _ : state) {
    Terms terms;
    const Id role = terms.iri("http://x/pose");
    for (std::uint32_t i = 1; i <= 1'000; ++i) {
      benchmark::DoNotOptimize(terms.text(terms.derived(role, {role, Id{i}})));
    }
  }
  per_item(state, 1'000);
}
BENCHMARK(BM_DerivedText);

// From a frame over its body to the body's other frames, as the expansion of a chain begins.
void BM_TraversalOfFourSteps(benchmark::State& state) {
  Data data(10'640);
  data.fill();
  const View view = data.store.view();
  const Quad& quad = data.quads[100];
  const auto walk =
      Traversal<>().as("start").out(quad.predicate).in(quad.predicate).where(equals("start"));
  for (auto _ : state) benchmark::DoNotOptimize(walk.first(view, quad.subject));
}
BENCHMARK(BM_TraversalOfFourSteps);

}  // namespace
}  // namespace sinew::graph
