// An algorithm model in memory: what the graph says of one algorithm, as plain values. The builder
// fills one while it writes the graph; `read` makes one from a graph, so that an algorithm that
// came from a file or was woven passes the same checks.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sinew/algorithm/names.h"
#include "sinew/algorithm/operators.h"
#include "sinew/graph/terms.h"

namespace sinew::algorithm {

inline constexpr std::uint32_t kNoIndex = 0xFFFFFFFF;

// What a state's model declares for a running program that is exchanged for this one, where the old
// one does not keep a state with the same IRI and the same prototype (sa:at-swap).
struct AtSwap {
  enum class Kind : std::uint8_t {
    kInitialise,  // the first value of the new model
    kOperator,    // an operator of the catalogue, from one block to one
    kScale,       // every number times a factor, which has a unit
  };
  Kind kind = Kind::kInitialise;
  graph::Id from;                // of kOperator, kScale: the old program's block
  const Operator* op = nullptr;  // kOperator
  double factor = 1;             // kScale
  std::string factor_unit;       // kScale, by its QUDT name
};

struct Block {
  graph::Id id;
  std::string slot;  // what it is for its element: "position", "pose-across-joint"
  std::string name;  // "position.joint1"; unique in the algorithm
  const Quantity* quantity = nullptr;
  graph::Id represents;  // the model element that it belongs to
  std::array<graph::Id, kAttributes> symbols = {};
  std::string unit;  // SI, QUDT names, space separated
  Role role = Role::kInternal;
  bool output = false;
  bool held = false;  // an input that changes slowly; or keeps its value from update to update
  std::uint32_t index = kNoIndex;  // place among the inputs, or among the outputs
  std::uint32_t size = 0;
  std::vector<double> value;           // of constants, and first value of states
  std::optional<AtSwap> at_swap = {};  // of states
};

// What an external closure must know beside its ports: "interface", "lower", ... A literal's text
// or an IRI.
struct Property {
  std::string name;  // short name of the property
  std::string value;
  friend auto operator<=>(const Property&, const Property&) = default;
};

struct Closure {
  graph::Id id;
  const Operator* op = nullptr;
  std::vector<std::uint32_t> arguments;  // blocks, in the order of the operator's ports
  std::vector<std::uint32_t> counts;     // how many arguments each port has; empty: one each
  graph::Id step;                        // that made it
  graph::Id about;                       // the model element that it was made for
  std::vector<Property> properties;      // of an external closure, sorted
};

struct Algorithm {
  graph::Id id;  // also the name of its graph
  std::vector<Block> blocks;
  std::vector<Closure> closures;
  std::vector<std::uint32_t> schedule;  // closures
  // How often it must run, where it integrates over time [s].
  std::optional<double> period_s = {};
};

// Calls visit(port, argument) for each argument of a closure.
template <typename Visit>
void for_each_argument(const Closure& closure, Visit&& visit) {
  std::size_t at = 0;
  for (std::size_t port = 0; port < closure.op->ports.size(); ++port) {
    const std::size_t count = closure.counts.empty() ? 1 : closure.counts[port];
    for (std::size_t i = 0; i < count; ++i) visit(closure.op->ports[port], closure.arguments[at++]);
  }
}

}  // namespace sinew::algorithm
