// The queries of bench/sparql/ on 1, 8 and 75 robots side by side (some 1,300, 10,800 and 101,000
// triples).
//
//   bench_sparql                                 prepared queries, anchors rotating; and preparing;
//                                                all_frames also with nothing remembered
// For bench/sparql/compare, which asks other engines the same:
//   bench_sparql --dump=FILE --copies=8          the data as N-Triples
//   bench_sparql --answers=FILE --copies=8       for each query its anchors and the rows found from
//                                                each, in N-Triples' terms, tab-separated
//   bench_sparql --table --copies=8              name, anchors, rows in all, ns per query, µs to
//                                                prepare; tab-separated
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>

#include "sinew/rdf/sparql/engine.h"
#include "sparql_data.h"

namespace {

using namespace sinew;
using bench::QueryFile;

const graph::Store& robots(std::size_t copies, graph::Store** writable = nullptr) {
  static std::map<std::size_t, std::unique_ptr<graph::Store>> stores;
  auto& store = stores[copies];
  if (!store) {
    store = std::make_unique<graph::Store>();
    bench::load_robots(*store, copies);
  }
  if (writable) *writable = store.get();
  return *store;
}

std::vector<std::string_view> views(const std::vector<std::string>& strings) {
  return {strings.begin(), strings.end()};
}

struct Anchored {
  std::shared_ptr<const rdf::sparql::Prepared> query;
  std::vector<std::vector<graph::Id>> anchors;
  std::size_t next = 0;

  Anchored(graph::Store& store, const QueryFile& file) {
    const auto names = views(file.parameters);
    query = rdf::sparql::prepare(store, file.text, names);
    const auto answer = rdf::sparql::query(store.view(), store.terms(), file.anchors);
    anchors = answer.results.rows;
  }
  std::size_t run(const graph::View& view, const std::vector<graph::Id>& anchor) const {
    if (query->is_ask()) return query->ask(view, anchor) ? 1 : 0;
    return query->select(view, anchor, [](std::span<const graph::Id> row) {
      benchmark::DoNotOptimize(row.data());
      return true;
    });
  }
};

void run_query(benchmark::State& state, const QueryFile& file, std::size_t copies,
               bool remember = true) {
  graph::Store* store = nullptr;
  robots(copies, &store);
  if (store->view().size() == 0) return state.SkipWithError("no published models here");
  const Anchored query(*store, file);
  // Of what a transaction sees, which may change, nothing is remembered.
  const graph::Transaction transaction = store->begin();
  const graph::View view = remember ? store->view() : transaction.view();
  std::size_t next = 0;
  std::size_t rows = 0;
  for (auto _ : state) {
    rows += query.run(view, query.anchors[next]);
    next = next + 1 < query.anchors.size() ? next + 1 : 0;
  }
  state.counters["anchors"] = static_cast<double>(query.anchors.size());
  state.counters["rows"] =
      benchmark::Counter(static_cast<double>(rows), benchmark::Counter::kAvgIterations);
}

void prepare_query(benchmark::State& state, const QueryFile& file) {
  graph::Store* store = nullptr;
  robots(8, &store);
  const auto names = views(file.parameters);
  for (auto _ : state) {
    benchmark::DoNotOptimize(rdf::sparql::prepare(*store, file.text, names));
  }
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

// The same figures as tab-separated text, for the comparison with other engines.
void print_table(std::size_t copies) {
  using Clock = std::chrono::steady_clock;
  using Nanoseconds = std::chrono::duration<double, std::nano>;
  graph::Store* store = nullptr;
  robots(copies, &store);
  for (const QueryFile& file : bench::query_files()) {
    const auto names = views(file.parameters);
    std::vector<double> prepares;
    for (int i = 0; i < 100; ++i) {
      const auto start = Clock::now();
      benchmark::DoNotOptimize(rdf::sparql::prepare(*store, file.text, names));
      prepares.push_back(Nanoseconds(Clock::now() - start).count() / 1000);
    }
    const double prepare_us = median(prepares);
    const Anchored query(*store, file);
    const graph::View view = store->view();
    std::size_t rows = 0;
    for (const auto& anchor : query.anchors) rows += query.run(view, anchor);
    // As the peers are timed: many short rounds, so that what else the machine does is in few.
    std::vector<double> rounds;
    const auto end = Clock::now() + std::chrono::milliseconds(150);
    while (Clock::now() < end || rounds.size() < 500) {
      const auto start = Clock::now();
      for (const auto& anchor : query.anchors) query.run(view, anchor);
      rounds.push_back(Nanoseconds(Clock::now() - start).count() /
                       static_cast<double>(query.anchors.size()));
    }
    std::cout << fmt::format("{}\t{}\t{}\t{:.1f}\t{:.1f}\n", file.name, query.anchors.size(), rows,
                             median(rounds), prepare_us);
  }
}

void dump(const std::string& path, std::size_t copies) {
  graph::Store* store = nullptr;
  robots(copies, &store);
  std::ofstream out(path);
  const graph::Terms& terms = store->terms();
  const auto write = [&](const graph::Quad& quad) {
    out << terms.to_string(quad.subject) << ' ' << terms.to_string(quad.predicate) << ' '
        << terms.to_string(quad.object) << " .\n";
    return true;
  };
  store->view().match({}, {}, {}, graph::Dataset::kUnion, write);
}

// One line each: "query NAME", then for each anchor "anchor TERM ..." and "row TERM ..." for what
// it leads to; ASK gives "row true" or "row false", and "-" is unbound.
void print_answers(const std::string& path, std::size_t copies) {
  graph::Store* store = nullptr;
  robots(copies, &store);
  std::ofstream out(path);
  const graph::View view = store->view();
  const auto write = [&](std::string_view what, std::span<const graph::Id> ids) {
    out << what;
    for (const graph::Id id : ids) out << '\t' << (id ? store->terms().to_string(id) : "-");
    out << '\n';
  };
  for (const QueryFile& file : bench::query_files()) {
    const Anchored query(*store, file);
    out << "query\t" << file.name << '\n';
    for (const auto& anchor : query.anchors) {
      write("anchor", anchor);
      if (query.query->is_ask()) {
        out << "row\t" << (query.query->ask(view, anchor) ? "true" : "false") << '\n';
        continue;
      }
      query.query->select(view, anchor, [&](std::span<const graph::Id> row) {
        write("row", row);
        return true;
      });
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string dump_to, answers_to;
  std::size_t copies = 8;
  bool table = false;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument.starts_with("--dump=")) dump_to = argument.substr(7);
    if (argument.starts_with("--answers=")) answers_to = argument.substr(10);
    if (argument.starts_with("--copies=")) copies = std::stoul(std::string(argument.substr(9)));
    if (argument == "--table") table = true;
  }
  if (!dump_to.empty() || !answers_to.empty() || table) {
    if (robots(copies).view().size() == 0) {
      std::cerr << "bench_sparql: the published models are not here (SINEW_SHARED_DIR)\n";
      return 1;
    }
    if (!dump_to.empty()) dump(dump_to, copies);
    if (!answers_to.empty()) print_answers(answers_to, copies);
    if (table) print_table(copies);
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  for (const QueryFile& file : bench::query_files()) {
    if (file.name == "all_frames") {
      benchmark::RegisterBenchmark("all_frames_anew/8", [file](benchmark::State& state) {
        run_query(state, file, 8, false);
      });
    }
    for (const std::size_t size : {1, 8, 75}) {
      benchmark::RegisterBenchmark(
          (file.name + "/" + std::to_string(size)).c_str(),
          [file, size](benchmark::State& state) { run_query(state, file, size); });
    }
    benchmark::RegisterBenchmark(("prepare/" + file.name).c_str(), [file](benchmark::State& state) {
      prepare_query(state, file);
    })->Unit(benchmark::kMicrosecond);
  }
  benchmark::RunSpecifiedBenchmarks();
}
