#include "sinew/program/passes/latency.h"

#include <algorithm>

#include "sinew/program/dag/evaluate.h"

namespace sinew::program {

std::vector<double> times_to_the_end(const Computation& computation) {
  const Dag& dag = computation.dag;
  std::vector<double> times(dag.size(), 0.0);
  const std::vector<std::uint8_t> live = live_nodes(computation);
  for (std::uint32_t i = dag.size(); i-- > 0;) {
    const Node& node = dag.node(i);
    const int operands = live[i] != 0 ? arity(node.op) : 0;
    const double from = times[i] + latency(node.op);
    const auto at_least = [&](Ref operand, bool is_one) {
      double& time = times[operand.node()];
      time = std::max(time, is_one ? from : 0.0);
    };
    at_least(node.a, operands > 0);
    at_least(node.b, operands > 1);
    at_least(node.c, operands > 2);
  }
  return times;
}

}  // namespace sinew::program
