// When each node of a graph can be ready at the earliest, in cycles of a typical processor with as
// many units as one likes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sinew/program/dag/dag.h"

namespace sinew::program {

// Cycles from operands to result: common to the x86-64 processors of the last years within one or
// two.
inline constexpr double kCycles[] = {0,  0,  3, 4, 4, 14, 18,  // constant, input, … square root
                                     60, 60,                   // sines: all at once
                                     3,  2};                   // comparing, choosing
constexpr double latency(Op op) { return kCycles[static_cast<std::uint8_t>(op)]; }
static_assert(latency(Op::kAdd) == 3 && latency(Op::kSqrt) == 18 && latency(Op::kSelect) == 2);

// For each node, the cycles from when it is ready to when the last result that needs it is ready.
std::vector<double> times_to_the_end(const Computation& computation);

// Follows a graph that grows.
class ReadyTimes {
 public:
  explicit ReadyTimes(const Dag& dag) : dag_(dag) {}
  double of(Ref ref) { return of(ref.node()); }
  double of(std::uint32_t node) {
    while (known_ <= node) follow(dag_.node(known_));
    return times_[node];
  }

 private:
  void follow(const Node& next) {
    if (known_ == times_.size()) times_.resize(2 * times_.size() + kFirstRoom);
    const int operands = arity(next.op);
    double start = 0.0;
    if (operands > 0) start = std::max(start, times_[next.a.node()]);
    if (operands > 1) start = std::max(start, times_[next.b.node()]);
    if (operands > 2) start = std::max(start, times_[next.c.node()]);
    times_[known_++] = start + latency(next.op);
  }

  static constexpr std::size_t kFirstRoom = 1024;

  const Dag& dag_;
  std::vector<double> times_;  // and room for more
  std::uint32_t known_ = 0;
};

}  // namespace sinew::program
