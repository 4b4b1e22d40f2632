#include "sinew/program/passes/latency.h"

#include <algorithm>

#include "sinew/program/dag/evaluate.h"

namespace sinew::program {

double latency(Op op) {
  switch (op) {
    case Op::kConstant:
    case Op::kInput:
      return 0.0;
    case Op::kAdd:
      return 3.0;
    case Op::kMultiply:
    case Op::kFma:
      return 4.0;
    case Op::kDivide:
      return 14.0;
    case Op::kSqrt:
      return 18.0;
    case Op::kSin:
    case Op::kCos:
      return 60.0;  // all angles at once, by polynomials
    case Op::kLess:
      return 3.0;
    case Op::kSelect:
      return 2.0;
  }
  return 0.0;
}

std::vector<double> times_to_the_end(const Computation& computation) {
  const Dag& dag = computation.dag;
  std::vector<double> times(dag.size(), 0.0);
  const std::vector<std::uint8_t> live = live_nodes(computation);
  for (std::uint32_t i = dag.size(); i-- > 0;) {
    if (!live[i]) continue;
    const Node& node = dag.node(i);
    const double from = times[i] + latency(node.op);
    const Ref operands[] = {node.a, node.b, node.c};
    for (int k = 0; k < arity(node.op); ++k) {
      double& time = times[operands[k].node()];
      time = std::max(time, from);
    }
  }
  return times;
}

double ReadyTimes::follow(std::uint32_t node) {
  while (times_.size() <= node) {
    const Node& next = dag_.node(static_cast<std::uint32_t>(times_.size()));
    const int operands = arity(next.op);
    double start = 0.0;
    if (operands > 0) start = std::max(start, times_[next.a.node()]);
    if (operands > 1) start = std::max(start, times_[next.b.node()]);
    if (operands > 2) start = std::max(start, times_[next.c.node()]);
    times_.push_back(start + latency(next.op));
  }
  return times_[node];
}

}  // namespace sinew::program
