#include "sinew/program/dag/evaluate.h"

#include <cmath>

namespace sinew::program {

std::vector<std::uint8_t> live_nodes(const Computation& computation) {
  const Dag& dag = computation.dag;
  std::vector<std::uint8_t> live(dag.size(), 0);
  for (const Ref result : computation.results) live[result.node()] = 1;
  // Operands have smaller indices than the nodes that use them. Where there are fewer than three,
  // the first node gets nothing: there is no branch to be guessed.
  for (std::uint32_t i = dag.size(); i-- > 0;) {
    const Node& node = dag.node(i);
    const int operands = arity(node.op);
    live[node.a.node()] |= operands > 0 ? live[i] : 0;
    live[node.b.node()] |= operands > 1 ? live[i] : 0;
    live[node.c.node()] |= operands > 2 ? live[i] : 0;
  }
  return live;
}

std::vector<double> evaluate(const Computation& computation, std::span<const double> inputs) {
  const Dag& dag = computation.dag;
  const std::vector<std::uint8_t> live = live_nodes(computation);
  std::vector<double> values(dag.size(), 0.0);
  const auto value = [&values](Ref ref) {
    return ref.negative() ? -values[ref.node()] : values[ref.node()];
  };
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    if (!live[i]) continue;
    const Node& node = dag.node(i);
    switch (node.op) {
      case Op::kConstant:
        values[i] = node.value;
        break;
      case Op::kInput:
        values[i] = inputs[node.index];
        break;
      case Op::kAdd:
        values[i] = value(node.a) + value(node.b);
        break;
      case Op::kMultiply:
        values[i] = value(node.a) * value(node.b);
        break;
      case Op::kFma:
        values[i] = std::fma(value(node.a), value(node.b), value(node.c));
        break;
      case Op::kDivide:
        values[i] = value(node.a) / value(node.b);
        break;
      case Op::kSqrt:
        values[i] = std::sqrt(value(node.a));
        break;
      case Op::kSin:
        values[i] = std::sin(value(node.a));
        break;
      case Op::kCos:
        values[i] = std::cos(value(node.a));
        break;
      case Op::kLess:
        values[i] = value(node.a) < value(node.b) ? 1.0 : 0.0;
        break;
      case Op::kSelect:
        values[i] = value(node.a) != 0.0 ? value(node.b) : value(node.c);
        break;
    }
  }
  std::vector<double> results;
  results.reserve(computation.results.size());
  for (const Ref result : computation.results) results.push_back(value(result));
  return results;
}

OperationCount count_operations(const Computation& computation) {
  const Dag& dag = computation.dag;
  const std::vector<std::uint8_t> live = live_nodes(computation);
  OperationCount count;
  std::vector<bool> angle_seen(dag.size(), false);
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    if (!live[i]) continue;
    const Node& node = dag.node(i);
    switch (node.op) {
      case Op::kConstant:
      case Op::kInput:
      case Op::kLess:
        break;
      case Op::kAdd:
        ++count.add;
        break;
      case Op::kMultiply:
        ++count.multiply;
        break;
      case Op::kFma:
        ++count.add;
        ++count.multiply;
        break;
      case Op::kDivide:
        ++count.divide;
        break;
      case Op::kSqrt:
        ++count.sqrt;
        break;
      case Op::kSin:
      case Op::kCos:
        if (!angle_seen[node.a.node()]) ++count.sincos;
        angle_seen[node.a.node()] = true;
        break;
      case Op::kSelect:
        ++count.select;
        break;
    }
  }
  return count;
}

}  // namespace sinew::program
