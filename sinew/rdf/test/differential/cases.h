// Random graphs and queries for the comparison of two SPARQL engines. The same number always gives
// the same graph or query, on every machine.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace sinew::rdf::differential {

inline constexpr int kGraphs = 5;
inline constexpr int kQueries = 2000;

// std::mt19937_64 is the same everywhere; the standard's distributions are not, hence these.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  int below(int bound) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(bound)); }
  bool chance(int percent) { return below(100) < percent; }
  template <typename Items>
  auto pick(const Items& items) {
    return items[static_cast<std::size_t>(below(static_cast<int>(std::size(items))))];
  }

 private:
  std::mt19937_64 engine_;
};

// A dataset as N-Quads. No triple is in two graphs, because engines disagree on whether the union
// of all graphs then holds it once or twice.
std::string make_graph(int number);

enum class Form { kSelect, kAsk, kConstruct };

struct Case {
  Form form;
  int graph;           // number of the graph to ask
  bool union_default;  // patterns outside GRAPH match the union of all graphs
  bool count_only =
      false;  // which rows come is up to the engine (LIMIT); only their number is fixed
  std::string query;
};
Case make_case(int number);

}  // namespace sinew::rdf::differential
