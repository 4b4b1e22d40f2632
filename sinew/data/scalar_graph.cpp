#include "sinew/data/scalar_graph.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

namespace sinew::data {
namespace {

using Op = ScalarOperation;

constexpr OperationRow kRows[] = {
    {"", "", 0, 0},                              // input
    {"", "", 0, 0},                              // constant
    {"", "$a + $b", 2, 1},                       // add
    {"", "$a - $b", 2, 1},                       // subtract
    {"", "$a * $b", 2, 1},                       // multiply
    {"", "$a / $b", 2, 4},                       // divide
    {"", "-$a", 1, 1},                           // negate
    {"sqrt", "sqrt($a)", 1, 4},                  // square root
    {"sin", "sin($a)", 1, 20},                   // sine
    {"cos", "cos($a)", 1, 20},                   // cosine
    {"tan", "tan($a)", 1, 20},                   // tangent
    {"asin", "asin($a)", 1, 20},                 // arc sine
    {"acos", "acos($a)", 1, 20},                 // arc cosine
    {"atan2", "atan2($a, $b)", 2, 30},           // arc tangent
    {"hypot", "sqrt($a * $a + $b * $b)", 2, 7},  // hypotenuse
    {"abs", "fabs($a)", 1, 1},                   // absolute value
    {"min", "fmin($a, $b)", 2, 1},               // minimum
    {"max", "fmax($a, $b)", 2, 1},               // maximum
    {"copysign", "copysign($a, $b)", 2, 1},      // sign
    {"", "($a < $b ? 1.0 : 0.0)", 2, 1},         // less
    {"select", "($a != 0.0 ? $b : $c)", 3, 1},   // select
};
static_assert(std::size(kRows) == std::size_t(Op::kSelect) + 1);

}  // namespace

const OperationRow& row(ScalarOperation operation) { return kRows[std::size_t(operation)]; }

double evaluate(ScalarOperation operation, double a, double b, double c) {
  switch (operation) {
    case Op::kAdd:
      return a + b;
    case Op::kSubtract:
      return a - b;
    case Op::kMultiply:
      return a * b;
    case Op::kDivide:
      return a / b;
    case Op::kNegate:
      return -a;
    case Op::kSquareRoot:
      return std::sqrt(a);
    case Op::kSine:
      return std::sin(a);
    case Op::kCosine:
      return std::cos(a);
    case Op::kTangent:
      return std::tan(a);
    case Op::kArcSine:
      return std::asin(a);
    case Op::kArcCosine:
      return std::acos(a);
    case Op::kArcTangent2:
      return std::atan2(a, b);
    case Op::kHypotenuse:
      return std::sqrt(a * a + b * b);
    case Op::kAbsolute:
      return std::fabs(a);
    case Op::kMinimum:
      return std::fmin(a, b);
    case Op::kMaximum:
      return std::fmax(a, b);
    case Op::kCopySign:
      return std::copysign(a, b);
    case Op::kLess:
      return a < b ? 1.0 : 0.0;
    case Op::kSelect:
      return a != 0.0 ? b : c;
    case Op::kInput:
    case Op::kConstant:
      break;
  }
  return 0;
}

ScalarGraph::Node ScalarGraph::make(const ScalarNode& node) {
  const auto key = std::make_tuple(node.operation, node.a, node.b, node.c,
                                   std::bit_cast<std::uint64_t>(node.value));
  const auto [known, added] = known_.try_emplace(key, static_cast<Node>(nodes_.size()));
  if (added) nodes_.push_back(node);
  return known->second;
}

ScalarGraph::Node ScalarGraph::input(std::uint32_t which) {
  return make({Op::kInput, which, 0, 0, 0});
}

ScalarGraph::Node ScalarGraph::constant(double value) {
  return make({Op::kConstant, 0, 0, 0, value});
}

bool ScalarGraph::is_constant(Node node, double value) const {
  return nodes_[node].operation == Op::kConstant && nodes_[node].value == value;
}

ScalarGraph::Node ScalarGraph::apply(ScalarOperation operation, Node a, Node b, Node c) {
  const int operands = row(operation).operands;
  if (operands < 2) b = 0;
  if (operands < 3) c = 0;
  const auto known = [&](Node node) { return nodes_[node].operation == Op::kConstant; };
  if (known(a) && (operands < 2 || known(b)) && (operands < 3 || known(c))) {
    return constant(evaluate(operation, nodes_[a].value, nodes_[b].value, nodes_[c].value));
  }
  switch (operation) {
    case Op::kAdd:
      if (is_constant(a, 0)) return b;
      if (is_constant(b, 0)) return a;
      if (nodes_[b].operation == Op::kNegate) return apply(Op::kSubtract, a, nodes_[b].a);
      if (a > b) std::swap(a, b);  // commutes: equal sums get equal nodes
      break;
    case Op::kSubtract:
      if (is_constant(b, 0)) return a;
      if (is_constant(a, 0)) return apply(Op::kNegate, b);
      if (nodes_[b].operation == Op::kNegate) return apply(Op::kAdd, a, nodes_[b].a);
      break;
    case Op::kMultiply:
      if (is_constant(a, 0) || is_constant(b, 0)) return constant(0);
      if (is_constant(a, 1)) return b;
      if (is_constant(b, 1)) return a;
      if (is_constant(a, -1)) return apply(Op::kNegate, b);
      if (is_constant(b, -1)) return apply(Op::kNegate, a);
      if (a > b) std::swap(a, b);
      break;
    case Op::kDivide:
      if (is_constant(b, 1)) return a;
      break;
    case Op::kNegate:
      if (nodes_[a].operation == Op::kNegate) return nodes_[a].a;
      if (nodes_[a].operation == Op::kSubtract) {
        return apply(Op::kSubtract, nodes_[a].b, nodes_[a].a);
      }
      break;
    case Op::kSelect:
      if (known(a)) return nodes_[a].value != 0 ? b : c;
      if (b == c) return b;
      break;
    default:
      break;
  }
  return make({operation, a, b, c, 0});
}

std::vector<ScalarGraph::Node> ScalarGraph::append(const ScalarGraph& other,
                                                   std::span<const Node> inputs) {
  std::vector<Node> place;
  place.reserve(other.nodes_.size());
  for (const ScalarNode& node : other.nodes_) {
    switch (node.operation) {
      case Op::kInput:
        place.push_back(inputs[node.a]);
        break;
      case Op::kConstant:
        place.push_back(constant(node.value));
        break;
      default: {
        const int operands = row(node.operation).operands;
        place.push_back(apply(node.operation, place[node.a], operands > 1 ? place[node.b] : 0,
                              operands > 2 ? place[node.c] : 0));
      }
    }
  }
  return place;
}

std::vector<bool> ScalarGraph::live(std::span<const Node> needed) const {
  std::vector<bool> live(nodes_.size(), false);
  for (const Node node : needed) live[node] = true;
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    if (!live[i] || nodes_[i].operation == Op::kInput) continue;
    const int operands = row(nodes_[i].operation).operands;
    if (operands > 0) live[nodes_[i].a] = true;
    if (operands > 1) live[nodes_[i].b] = true;
    if (operands > 2) live[nodes_[i].c] = true;
  }
  return live;
}

int ScalarGraph::cost(std::span<const Node> needed) const {
  const std::vector<bool> used = live(needed);
  int sum = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (used[i]) sum += row(nodes_[i].operation).cost;
  }
  return sum;
}

}  // namespace sinew::data
