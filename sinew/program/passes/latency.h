// When each node of a graph can be ready at the earliest, in cycles of a typical processor with as
// many units as one likes.
#pragma once

#include <vector>

#include "sinew/program/dag/dag.h"

namespace sinew::program {

// Cycles from operands to result: common to the x86-64 processors of the last years within one or
// two.
double latency(Op op);

// For each node, the cycles from when it is ready to when the last result that needs it is ready.
std::vector<double> times_to_the_end(const Computation& computation);

// Follows a graph that grows.
class ReadyTimes {
 public:
  explicit ReadyTimes(const Dag& dag) : dag_(dag) {}
  double of(Ref ref) { return of(ref.node()); }
  double of(std::uint32_t node) { return node < times_.size() ? times_[node] : follow(node); }

 private:
  double follow(std::uint32_t node);

  const Dag& dag_;
  std::vector<double> times_;
};

}  // namespace sinew::program
