#include "sinew/program/passes/schedule.h"

#include <algorithm>
#include <queue>
#include <set>

#include "sinew/program/dag/evaluate.h"
#include "sinew/program/passes/latency.h"

namespace sinew::program {
namespace {

// Constants and inputs are read from memory where they are used; sines lie in memory as well.
bool in_register(Op op) { return arity(op) > 0 && op != Op::kSin && op != Op::kCos; }

template <typename Visit>
void for_each_operand(const Node& node, Visit visit) {
  const Ref operands[] = {node.a, node.b, node.c};
  for (int k = 0; k < arity(node.op); ++k) {
    bool repeated = false;
    for (int j = 0; j < k; ++j) repeated = repeated || operands[j].node() == operands[k].node();
    if (!repeated) visit(operands[k].node());
  }
}

class Scheduler {
 public:
  explicit Scheduler(const Computation& computation)
      : dag_(computation.dag),
        live_(live_nodes(computation)),
        tails_(times_to_the_end(computation)) {
    const std::uint32_t n = dag_.size();
    users_.resize(n);
    missing_.assign(n, 0);
    unread_.assign(n, 0);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (!live_[i]) continue;
      for_each_operand(dag_.node(i), [&](std::uint32_t operand) {
        users_[operand].push_back(i);
        ++unread_[operand];
        ++missing_[i];
      });
    }
    for (const Ref result : computation.results) ++unread_[result.node()];  // live to the end
  }

  std::vector<std::uint32_t> run() {
    for (std::uint32_t i = 0; i < dag_.size(); ++i) {
      if (live_[i] && missing_[i] == 0) ready_.insert(i);
    }
    std::vector<std::uint32_t> order;
    while (!ready_.empty()) {
      const std::uint32_t next = choose();
      ready_.erase(next);
      order.push_back(next);
      const Node& node = dag_.node(next);
      for_each_operand(node, [&](std::uint32_t operand) {
        if (--unread_[operand] == 0 && in_register(dag_.node(operand).op)) --count_;
      });
      if (in_register(node.op)) ++count_;
      for (const std::uint32_t user : users_[next]) {
        if (--missing_[user] == 0) ready_.insert(user);
      }
    }
    return order;
  }

 private:
  // How many values more are live after the node.
  int growth(std::uint32_t i) const {
    int change = in_register(dag_.node(i).op) ? 1 : 0;
    for_each_operand(dag_.node(i), [&](std::uint32_t operand) {
      if (unread_[operand] == 1 && in_register(dag_.node(operand).op)) --change;
    });
    return change;
  }

  std::uint32_t choose() const {
    std::uint32_t best = *ready_.begin();
    const bool full = count_ >= kLiveLimit;
    int best_growth = growth(best);
    for (const std::uint32_t i : ready_) {
      if (dag_.node(i).op == Op::kConstant || dag_.node(i).op == Op::kInput) return i;  // free
      const int g = growth(i);
      const bool better = full ? g < best_growth || (g == best_growth && tails_[i] > tails_[best])
                               : tails_[i] > tails_[best];
      if (better) {
        best = i;
        best_growth = g;
      }
    }
    return best;
  }

  const Dag& dag_;
  std::vector<bool> live_;
  std::vector<double> tails_;
  std::vector<std::vector<std::uint32_t>> users_;
  std::vector<std::uint32_t> missing_;  // operands that have not been scheduled
  std::vector<std::uint32_t> unread_;   // users that have not been scheduled
  std::set<std::uint32_t> ready_;
  std::uint32_t count_ = 0;
};

}  // namespace

std::uint32_t live_values(const Computation& computation) {
  const Dag& dag = computation.dag;
  const std::vector<bool> live = live_nodes(computation);
  std::vector<std::uint32_t> unread(dag.size(), 0);
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    if (live[i]) for_each_operand(dag.node(i), [&](std::uint32_t operand) { ++unread[operand]; });
  }
  for (const Ref result : computation.results) ++unread[result.node()];
  std::uint32_t count = 0;
  std::uint32_t most = 0;
  const auto visit = [&](std::uint32_t i) {
    if (!live[i]) return;
    for_each_operand(dag.node(i), [&](std::uint32_t operand) {
      if (--unread[operand] == 0 && in_register(dag.node(operand).op)) --count;
    });
    if (in_register(dag.node(i).op)) most = std::max(most, ++count);
  };
  if (computation.order.empty()) {
    for (std::uint32_t i = 0; i < dag.size(); ++i) visit(i);
  } else {
    for (const std::uint32_t i : computation.order) visit(i);
  }
  return most;
}

Computation schedule(Computation computation) {
  computation.order.clear();
  const std::uint32_t before = live_values(computation);
  computation.order = Scheduler(computation).run();
  if (before > kLiveLimit && live_values(computation) > before) computation.order.clear();
  return computation;
}

}  // namespace sinew::program
