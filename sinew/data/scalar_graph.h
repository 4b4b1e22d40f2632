// Straight-line arithmetic as a graph: each node is one operation on earlier nodes. Formulas of
// domains are such graphs, and so is a whole conversion between its loads and its stores.
//
// Nodes are made by ScalarGraph's functions, which share equal nodes and fold what is constant, so
// that a scale of 1 or a product with a known zero costs nothing. Only rewrites that keep every
// finite result bit by bit are made; x * 0 becomes 0, which is where infinities and NaN would
// differ.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace sinew::data {

enum class ScalarOperation : std::uint8_t {
  kInput,  // `a` says which
  kConstant,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kNegate,
  kSquareRoot,
  kSine,
  kCosine,
  kTangent,
  kArcSine,
  kArcCosine,
  kArcTangent2,
  kHypotenuse,
  kAbsolute,
  kMinimum,
  kMaximum,
  kCopySign,
  kLess,    // 1 or 0
  kSelect,  // a != 0 ? b : c
};

// One row for each operation: how it is written in formulas, and what it costs.
struct OperationRow {
  std::string_view name;    // of the function in a formula; empty for operators
  std::string_view c_form;  // C source, with $a, $b, $c for the operands
  int operands;
  int cost;  // in additions: the measure of a conversion's cost
};
const OperationRow& row(ScalarOperation operation);

struct ScalarNode {
  ScalarOperation operation = ScalarOperation::kConstant;
  std::uint32_t a = 0, b = 0, c = 0;
  double value = 0;
};

class ScalarGraph {
 public:
  using Node = std::uint32_t;

  Node input(std::uint32_t which);
  Node constant(double value);
  Node apply(ScalarOperation operation, Node a, Node b = 0, Node c = 0);

  const std::vector<ScalarNode>& nodes() const { return nodes_; }
  bool is_constant(Node node, double value) const;
  // Repeats another graph's nodes here, with `inputs` in place of its inputs; gives the place of
  // each.
  std::vector<Node> append(const ScalarGraph& other, std::span<const Node> inputs);
  // The sum of the costs of the nodes that the given ones need.
  int cost(std::span<const Node> needed) const;
  // For each node, whether one of `needed` depends on it.
  std::vector<bool> live(std::span<const Node> needed) const;

 private:
  Node make(const ScalarNode& node);

  std::vector<ScalarNode> nodes_;
  std::map<std::tuple<ScalarOperation, Node, Node, Node, std::uint64_t>, Node> known_;
};

// The value of one operation on numbers; not for kInput and kConstant.
double evaluate(ScalarOperation operation, double a, double b, double c);

}  // namespace sinew::data
