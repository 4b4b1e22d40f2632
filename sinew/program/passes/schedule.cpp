#include "sinew/program/passes/schedule.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

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
    missing_.assign(n, 0);
    unread_.assign(n, 0);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (!live_[i]) continue;
      for_each_operand(dag_.node(i), [&](std::uint32_t operand) {
        ++unread_[operand];
        ++missing_[i];
      });
    }
    users_.from.assign(n + 1, 0);
    for (std::uint32_t i = 0; i < n; ++i) users_.from[i + 1] = users_.from[i] + unread_[i];
    users_.all.resize(users_.from[n]);
    std::vector<std::uint32_t> next = users_.from;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (!live_[i]) continue;
      for_each_operand(dag_.node(i),
                       [&](std::uint32_t operand) { users_.all[next[operand]++] = i; });
    }
  }

  // The most values that were live at a time, after run(): what live_values() says of the order.
  std::uint32_t most() const { return most_; }

  std::vector<std::uint32_t> run() {
    const std::uint32_t n = dag_.size();
    growth_.assign(n, 0);
    state_.assign(n, State::kWaiting);
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> free;  // constants and inputs: they come first
    for (std::uint32_t i = 0; i < n; ++i) {
      if (!live_[i]) continue;
      growth_[i] = stays(i) ? 1 : 0;
      for_each_operand(dag_.node(i), [&](std::uint32_t operand) {
        if (unread_[operand] == 1 && in_register(dag_.node(operand).op)) --growth_[i];
      });
      if (missing_[i] == 0) free.push_back(i);
    }
    for (const std::uint32_t i : free) take(i, order);
    for (;;) {
      const std::uint32_t next = choose();
      if (next == kNone) return order;
      take(next, order);
    }
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr int kLeastGrowth = -3;  // frees three, needs none
  static constexpr int kGrowths = 5;       // up to 1

  // Of each node, one after the other.
  struct Users {
    std::vector<std::uint32_t> all, from;
    std::span<const std::uint32_t> operator[](std::uint32_t i) const {
      return {all.data() + from[i], from[i + 1] - from[i]};
    }
  };

  enum class State : std::uint8_t { kWaiting, kReady, kDone };

  // What the longest path waits for comes first, then the smaller number.
  struct Later {
    const std::vector<double>& tails;
    bool operator()(std::uint32_t a, std::uint32_t b) const {
      return tails[a] != tails[b] ? tails[a] < tails[b] : a > b;
    }
  };
  using Queue = std::vector<std::uint32_t>;  // a heap; may hold nodes that are no longer in it

  // A result that nobody else needs is written at once.
  bool stays(std::uint32_t i) const { return in_register(dag_.node(i).op) && !users_[i].empty(); }

  Queue& queue_of(std::uint32_t i) {
    return ready_[static_cast<std::size_t>(growth_[i] - kLeastGrowth)];
  }
  void push(std::uint32_t i) {
    state_[i] = State::kReady;
    Queue& queue = queue_of(i);
    queue.push_back(i);
    std::push_heap(queue.begin(), queue.end(), Later{tails_});
  }
  // The first node of a queue that is still in it, or kNone.
  std::uint32_t first(Queue& queue) {
    while (!queue.empty()) {
      const std::uint32_t i = queue.front();
      if (state_[i] == State::kReady && &queue_of(i) == &queue) return i;
      std::pop_heap(queue.begin(), queue.end(), Later{tails_});
      queue.pop_back();
    }
    return kNone;
  }

  void take(std::uint32_t next, std::vector<std::uint32_t>& order) {
    state_[next] = State::kDone;
    order.push_back(next);
    const Node& node = dag_.node(next);
    for_each_operand(node, [&](std::uint32_t operand) {
      const bool counts = in_register(dag_.node(operand).op);
      if (--unread_[operand] == 0 && counts) --count_;
      if (unread_[operand] != 1 || !counts) return;
      // Who reads it last frees it.
      for (const std::uint32_t user : users_[operand]) {
        if (state_[user] == State::kDone) continue;
        --growth_[user];
        if (state_[user] == State::kReady) push(user);
      }
    });
    if (in_register(node.op)) most_ = std::max(most_, count_ + 1);
    if (stays(next)) ++count_;
    for (const std::uint32_t user : users_[next]) {
      if (--missing_[user] == 0) push(user);
    }
  }

  // With few values live, what the longest path waits for; otherwise what frees most values.
  std::uint32_t choose() {
    const bool full = count_ >= kLiveLimit;
    std::uint32_t best = kNone;
    for (Queue& queue : ready_) {
      const std::uint32_t i = first(queue);
      if (i == kNone) continue;
      if (best == kNone || Later{tails_}(best, i)) best = i;
      if (full) break;
    }
    return best;
  }

  const Dag& dag_;
  std::vector<std::uint8_t> live_;
  std::vector<double> tails_;
  Users users_;
  std::vector<std::uint32_t> missing_;  // operands that have not been scheduled
  std::vector<std::uint32_t> unread_;   // users that have not been scheduled
  std::vector<int> growth_;             // values more that are live after the node
  std::vector<State> state_;
  std::array<Queue, kGrowths> ready_;  // by growth
  std::uint32_t count_ = 0;            // values that are live
  std::uint32_t most_ = 0;
};

}  // namespace

std::uint32_t live_values(const Computation& computation) {
  const Dag& dag = computation.dag;
  const std::vector<std::uint8_t> live = live_nodes(computation);
  std::vector<std::uint32_t> unread(dag.size(), 0);
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    if (live[i]) for_each_operand(dag.node(i), [&](std::uint32_t operand) { ++unread[operand]; });
  }
  std::uint32_t count = 0;
  std::uint32_t most = 0;
  const auto visit = [&](std::uint32_t i) {
    if (!live[i]) return;
    for_each_operand(dag.node(i), [&](std::uint32_t operand) {
      if (--unread[operand] == 0 && in_register(dag.node(operand).op)) --count;
    });
    if (in_register(dag.node(i).op)) most = std::max(most, count + 1);
    if (in_register(dag.node(i).op) && unread[i] > 0) ++count;
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
  Scheduler scheduler(computation);
  std::vector<std::uint32_t> order = scheduler.run();
  if (before <= kLiveLimit || scheduler.most() <= before) computation.order = std::move(order);
  return computation;
}

}  // namespace sinew::program
