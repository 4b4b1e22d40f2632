#include "sinew/program/passes/schedule.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <utility>

#include "sinew/program/dag/evaluate.h"
#include "sinew/program/passes/latency.h"

namespace sinew::program {
namespace {

// Constants and inputs are read from memory where they are used; sines lie in memory as well.
bool in_register(Op op) { return arity(op) > 0 && op != Op::kSin && op != Op::kCos; }

// Each once.
template <typename Visit>
void for_each_operand(const Node& node, Visit visit) {
  const int count = arity(node.op);
  const std::uint32_t a = node.a.node(), b = node.b.node(), c = node.c.node();
  if (count > 0) visit(a);
  if (count > 1 && b != a) visit(b);
  if (count > 2 && c != a && c != b) visit(c);
}

class Scheduler {
 public:
  explicit Scheduler(const Computation& computation)
      : dag_(computation.dag), tails_(times_to_the_end(computation)), all_(dag_.size()) {
    const std::vector<std::uint8_t> live = live_nodes(computation);
    const std::uint32_t n = dag_.size();
    for (std::uint32_t i = 0; i < n; ++i) {
      const Node& node = dag_.node(i);
      Value& value = all_[i];
      value.is_live = live[i] != 0;
      value.in_register = in_register(node.op);
      if (!value.is_live) continue;
      for_each_operand(node, [&](std::uint32_t operand) {
        value.operands[value.missing++] = operand;
        ++all_[operand].unread;
        all_[operand].last_user = i;
      });
      value.count = value.missing;
    }
    std::uint32_t first = 0;
    for (Value& value : all_) {
      value.users = first;
      first += value.unread;
      value.stays = value.in_register && value.unread > 0;
    }
    users_.resize(first);
    std::vector<std::uint32_t> next(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      next[i] = all_[i].users;
      for (const std::uint32_t operand : all_[i].operands_of()) users_[next[operand]++] = i;
    }
  }

  // The most values that are live at a time in the order of the nodes.
  std::uint32_t most_by_index() const {
    std::uint32_t count = 0, most = 0;
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
      const Value& value = all_[i];
      if (!value.is_live) continue;
      for (const std::uint32_t operand : value.operands_of()) {
        const Value& read = all_[operand];
        count -= read.last_user == i && read.in_register ? 1 : 0;
      }
      if (value.in_register) most = std::max(most, count + 1);
      count += value.stays ? 1 : 0;
    }
    return most;
  }

  // The same of the order that run() returned.
  std::uint32_t most() const { return most_; }

  std::vector<std::uint32_t> run() {
    const std::uint32_t n = dag_.size();
    order_.reserve(n);
    std::vector<std::uint32_t> free;  // constants and inputs: they come first
    for (std::uint32_t i = 0; i < n; ++i) {
      Value& value = all_[i];
      if (!value.is_live) continue;
      // A result that nobody else needs is written at once.
      value.growth = value.stays ? 1 : 0;
      for (const std::uint32_t operand : value.operands_of()) {
        const Value& read = all_[operand];
        value.growth -= read.unread == 1 && read.in_register ? 1 : 0;
      }
      if (value.missing == 0) free.push_back(i);
    }
    for (const std::uint32_t i : free) take(i);
    for (;;) {
      const std::uint32_t next = choose();
      if (next == kNone) return std::move(order_);
      take(next);
    }
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr int kLeastGrowth = -3;  // frees three, needs none
  static constexpr int kGrowths = 5;       // up to 1

  enum class State : std::uint8_t { kWaiting, kReady, kDone };

  struct Value {
    std::array<std::uint32_t, 3> operands{};  // each once
    std::uint32_t users = 0;                  // the first of them in users_
    std::uint32_t unread = 0;                 // users that have not been scheduled
    std::uint32_t last_user = kNone;          // by index
    std::uint8_t count = 0;                   // of operands
    std::uint8_t missing = 0;                 // operands that have not been scheduled
    std::int8_t growth = 0;                   // values more that are live after it
    State state = State::kWaiting;
    bool is_live = false, in_register = false;
    bool stays = false;  // lives on when it has been computed

    std::span<const std::uint32_t> operands_of() const { return {operands.data(), count}; }
  };

  // What the longest path waits for comes first, then the smaller number: as one number.
  using Key = std::uint64_t;
  static constexpr bool kWholeCycles = std::all_of(
      std::begin(kCycles), std::end(kCycles),
      [](double cycles) { return cycles == static_cast<double>(static_cast<int>(cycles)); });
  static_assert(kWholeCycles && Dag::kMaximumNodes * 60.0 < 0xffffffff);
  Key key(std::uint32_t i) const {
    return static_cast<Key>(tails_[i]) << 32U | static_cast<std::uint32_t>(~i);
  }
  static std::uint32_t node_of(Key key) { return ~static_cast<std::uint32_t>(key); }
  using Queue = std::vector<Key>;  // a heap; may hold nodes that are no longer in it

  std::span<const std::uint32_t> users_of(std::uint32_t i) const {
    const std::size_t end = i + 1 < all_.size() ? all_[i + 1].users : users_.size();
    return {users_.data() + all_[i].users, end - all_[i].users};
  }

  Queue& queue_of(const Value& value) {
    return ready_[static_cast<std::size_t>(value.growth - kLeastGrowth)];
  }
  void push(std::uint32_t i) {
    all_[i].state = State::kReady;
    Queue& queue = queue_of(all_[i]);
    queue.push_back(key(i));
    std::push_heap(queue.begin(), queue.end());
  }
  // The first node of a queue that is still in it; 0 if there is none, which is no node's key.
  Key first(Queue& queue) {
    while (!queue.empty()) {
      const Value& value = all_[node_of(queue.front())];
      if (value.state == State::kReady && &queue_of(value) == &queue) return queue.front();
      std::pop_heap(queue.begin(), queue.end());
      queue.pop_back();
    }
    return 0;
  }

  void take(std::uint32_t next) {
    Value& taken = all_[next];
    taken.state = State::kDone;
    order_.push_back(next);
    for (const std::uint32_t operand : taken.operands_of()) {
      Value& read = all_[operand];
      --read.unread;
      if (!read.in_register) continue;
      if (read.unread == 0) --count_;
      if (read.unread != 1) continue;
      // Who reads it last frees it.
      for (const std::uint32_t user : users_of(operand)) {
        Value& last = all_[user];
        if (last.state == State::kDone) continue;
        --last.growth;
        if (last.state == State::kReady) push(user);
        break;
      }
    }
    if (taken.in_register) most_ = std::max(most_, count_ + 1);
    count_ += taken.stays ? 1 : 0;
    for (const std::uint32_t user : users_of(next)) {
      if (--all_[user].missing == 0) push(user);
    }
  }

  // With few values live, what the longest path waits for; otherwise what frees most values.
  std::uint32_t choose() {
    const bool full = count_ >= kLiveLimit;
    Key best = 0;
    for (Queue& queue : ready_) {
      best = std::max(best, first(queue));
      if (full && best != 0) break;
    }
    return best == 0 ? kNone : node_of(best);
  }

  const Dag& dag_;
  std::vector<double> tails_;
  std::vector<Value> all_;            // of each node
  std::vector<std::uint32_t> users_;  // of each node, one after the other
  std::vector<std::uint32_t> order_;
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
  Scheduler scheduler(computation);
  const std::uint32_t before = scheduler.most_by_index();
  std::vector<std::uint32_t> order = scheduler.run();
  if (before <= kLiveLimit || scheduler.most() <= before) computation.order = std::move(order);
  return computation;
}

}  // namespace sinew::program
