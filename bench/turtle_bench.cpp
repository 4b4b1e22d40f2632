// Reading and writing of Turtle and N-Quads, in bytes of text a second, on a document like our
// models: joints with frames, nested coordinates with units, lists of numbers.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "sinew/rdf/isomorphism/isomorphism.h"
#include "sinew/rdf/turtle/reader.h"
#include "sinew/rdf/turtle/writer.h"

namespace {

using namespace sinew;
using rdf::Syntax;

constexpr int kJoints = 20'000;

const rdf::Prefixes kPrefixes{{"arm", "http://example.org/robots/arm/"},
                              {"kc", "http://example.org/kinematic-chain#"},
                              {"geom", "http://example.org/geometry/coordinates#"},
                              {"unit", "http://qudt.org/vocab/unit/"}};

std::string turtle_text() {
  std::string text;
  for (const rdf::Prefix& prefix : kPrefixes.list()) {
    text += "@prefix " + prefix.name + ": <" + prefix.iri + "> .\n";
  }
  for (int i = 0; i < kJoints; ++i) {
    const std::string n = std::to_string(i), next = std::to_string(i + 1);
    text += "arm:joint" + n + " a kc:Joint, kc:RevoluteJoint ;\n";
    text += "    kc:between-attachments arm:frame" + n + "-out, arm:frame" + next + "-in ;\n";
    text += "    kc:common-axis arm:axis" + n + " ;\n";
    text += "    geom:pose [ a geom:PoseCoordinate ; geom:seen-by arm:frame" + n +
            "-out ; geom:unit unit:M, unit:RAD ;\n";
    text += "        geom:position ( 0.125 -" + n + ".5e-3 0.0 ) ; geom:label \"pose " + n +
            "\"@en ] .\n";
  }
  return text;
}

std::vector<graph::Quad> read(std::string_view text, Syntax syntax, graph::Terms& terms) {
  std::vector<graph::Quad> quads;
  read_rdf(text, syntax, {}, terms,
           [&](const graph::Quad& quad, std::size_t, std::size_t) { quads.push_back(quad); });
  return quads;
}

std::string text_in(Syntax syntax) {
  graph::Terms terms;
  return write_rdf(read(turtle_text(), Syntax::kTurtle, terms), syntax, terms, {kPrefixes, true});
}

void report_bytes(benchmark::State& state, std::size_t bytes) {
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes) * state.iterations());
}

// Into a dictionary that is empty at first, as when a model is loaded.
void Read(benchmark::State& state, Syntax syntax) {
  const std::string text = text_in(syntax);
  for (auto _ : state) {
    graph::Terms terms;
    std::size_t count = 0;
    read_rdf(text, syntax, {}, terms,
             [&](const graph::Quad&, std::size_t, std::size_t) { ++count; });
    benchmark::DoNotOptimize(count);
  }
  report_bytes(state, text.size());
}

void Write(benchmark::State& state, Syntax syntax, bool sorted) {
  graph::Terms terms;
  const std::vector<graph::Quad> quads = read(turtle_text(), Syntax::kTurtle, terms);
  std::size_t size = 0;
  for (auto _ : state) {
    size = write_rdf(quads, syntax, terms, {kPrefixes, sorted}).size();
  }
  report_bytes(state, size);
}

void Compare(benchmark::State& state) {
  graph::Terms terms;
  const std::string text = turtle_text();
  const std::vector<graph::Quad> left = read(text, Syntax::kTurtle, terms);
  const std::vector<graph::Quad> right = read(text, Syntax::kTurtle, terms);
  for (auto _ : state) benchmark::DoNotOptimize(rdf::compare_quads(left, right, terms));
  state.SetItemsProcessed(static_cast<std::int64_t>(left.size()) * state.iterations());
}

BENCHMARK_CAPTURE(Read, turtle, Syntax::kTurtle)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Read, nquads, Syntax::kNQuads)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Write, turtle, Syntax::kTurtle, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Write, nquads_as_given, Syntax::kNQuads, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Write, nquads_sorted, Syntax::kNQuads, true)->Unit(benchmark::kMillisecond);
BENCHMARK(Compare)->Unit(benchmark::kMillisecond);

}  // namespace
