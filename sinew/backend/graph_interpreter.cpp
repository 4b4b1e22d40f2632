#include "sinew/backend/graph_interpreter.h"

#include <cmath>

#include "sinew/program/dag/evaluate.h"

namespace sinew::backend {

using program::Node;
using program::Op;

GraphInterpreter::GraphInterpreter(const program::Computation& computation) {
  const program::Dag& dag = computation.dag;
  const std::vector<std::uint8_t> live = program::live_nodes(computation);
  std::vector<std::uint32_t> place(dag.size());
  const auto operand = [&](program::Ref ref) { return Operand{place[ref.node()], ref.negative()}; };
  // Operands have smaller indices than the nodes that use them.
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    if (!live[i]) continue;
    const Node& node = dag.node(i);
    place[i] = static_cast<std::uint32_t>(values_.size());
    values_.push_back(node.op == Op::kConstant ? node.value : 0.0);
    if (node.op == Op::kInput) inputs_.push_back({node.index, place[i]});
    const int operands = program::arity(node.op);
    if (operands == 0) continue;
    operations_.push_back({node.op, place[i], operand(node.a),
                           operands > 1 ? operand(node.b) : Operand{},
                           operands > 2 ? operand(node.c) : Operand{}});
  }
  for (const program::Ref result : computation.results) results_.push_back(operand(result));
}

void GraphInterpreter::evaluate(const double* in, double* out) {
  for (const Input& input : inputs_) values_[input.place] = in[input.index];
  for (const Operation& o : operations_) {
    double& to = values_[o.place];
    switch (o.op) {
      case Op::kAdd:
        to = value(o.a) + value(o.b);
        break;
      case Op::kMultiply:
        to = value(o.a) * value(o.b);
        break;
      case Op::kFma:
        to = std::fma(value(o.a), value(o.b), value(o.c));
        break;
      case Op::kDivide:
        to = value(o.a) / value(o.b);
        break;
      case Op::kSqrt:
        to = std::sqrt(value(o.a));
        break;
      case Op::kSin:
        to = std::sin(value(o.a));
        break;
      case Op::kCos:
        to = std::cos(value(o.a));
        break;
      case Op::kLess:
        to = value(o.a) < value(o.b) ? 1.0 : 0.0;
        break;
      case Op::kSelect:
        to = value(o.a) != 0.0 ? value(o.b) : value(o.c);
        break;
      case Op::kConstant:
      case Op::kInput:
        break;
    }
  }
  for (const Operand& result : results_) *out++ = value(result);
}

}  // namespace sinew::backend
