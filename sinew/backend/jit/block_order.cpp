#include "sinew/backend/jit/block_order.h"

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "sinew/program/dag/evaluate.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::Dag;
using program::Node;
using program::Op;
using program::Ref;

// Constants and inputs are read from memory, and so are sines.
bool in_register(const Node& node) {
  return program::arity(node.op) > 0 && node.op != Op::kSin && node.op != Op::kCos;
}

// Each once.
std::vector<std::uint32_t> operands_of(const Node& node) {
  std::vector<std::uint32_t> result;
  const Ref operands[] = {node.a, node.b, node.c};
  for (int k = 0; k < program::arity(node.op); ++k) {
    const std::uint32_t operand = operands[k].node();
    if (std::find(result.begin(), result.end(), operand) == result.end()) result.push_back(operand);
  }
  return result;
}

class FrugalOrder {
 public:
  explicit FrugalOrder(const Computation& computation)
      : dag_(computation.dag),
        users_(dag_.size()),
        missing_(dag_.size(), 0),
        unread_(dag_.size(), 0),
        growth_(dag_.size(), 0) {
    const std::vector<std::uint8_t> live = program::live_nodes(computation);
    for (std::uint32_t i = 0; i < dag_.size(); ++i) {
      if (!live[i]) continue;
      for (const std::uint32_t operand : operands_of(dag_.node(i))) {
        users_[operand].push_back(i);
        ++missing_[i];
        ++unread_[operand];
      }
    }
    for (std::uint32_t i = 0; i < dag_.size(); ++i) {
      if (!live[i]) continue;
      // What needs no operation is there from the beginning.
      const bool is_given = program::arity(dag_.node(i).op) == 0;
      growth_[i] = is_given ? kFirst : users_[i].empty() ? 0 : 1;
      for (const std::uint32_t operand : operands_of(dag_.node(i))) growth_[i] -= frees(operand);
      if (missing_[i] == 0) ready_.insert({growth_[i], i});
    }
  }

  std::vector<std::uint32_t> run() {
    while (!ready_.empty()) {
      const std::uint32_t next = ready_.begin()->second;
      ready_.erase(ready_.begin());
      take(next);
    }
    return std::move(order_);
  }

 private:
  static constexpr int kFirst = -4;  // an operation frees three values at most

  // Values that its only reader frees.
  int frees(std::uint32_t operand) const {
    return unread_[operand] == 1 && in_register(dag_.node(operand)) ? 1 : 0;
  }

  void take(std::uint32_t node) {
    order_.push_back(node);
    missing_[node] = -1;
    for (const std::uint32_t operand : operands_of(dag_.node(node))) {
      --unread_[operand];
      if (frees(operand) == 0) continue;
      for (const std::uint32_t user : users_[operand]) {
        if (missing_[user] < 0) continue;
        const bool was_ready = ready_.erase({growth_[user], user}) > 0;
        --growth_[user];
        if (was_ready) ready_.insert({growth_[user], user});
      }
    }
    for (const std::uint32_t user : users_[node]) {
      if (--missing_[user] == 0) ready_.insert({growth_[user], user});
    }
  }

  const Dag& dag_;
  std::vector<std::vector<std::uint32_t>> users_;
  std::vector<int> missing_;           // operands that are not there yet; -1: it is there itself
  std::vector<std::uint32_t> unread_;  // users that are not there yet
  std::vector<int> growth_;            // values more that are alive after the node
  std::set<std::pair<int, std::uint32_t>> ready_;
  std::vector<std::uint32_t> order_;
};

}  // namespace

std::vector<std::uint32_t> frugal_order(const Computation& computation) {
  return FrugalOrder(computation).run();
}

std::vector<std::uint32_t> depth_first_order(const Computation& computation) {
  const Dag& dag = computation.dag;
  std::vector<std::uint32_t> need(dag.size(), 0);  // registers
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    if (!in_register(dag.node(i))) continue;
    std::vector<std::uint32_t> of;
    for (const std::uint32_t operand : operands_of(dag.node(i))) of.push_back(need[operand]);
    std::sort(of.begin(), of.end(), std::greater<>());
    need[i] = 1;
    for (std::uint32_t k = 0; k < of.size(); ++k) {
      if (of[k] > 0) need[i] = std::max(need[i], of[k] + k);
    }
  }

  std::vector<std::uint32_t> order;
  std::vector<bool> begun(dag.size(), false);
  std::vector<std::pair<std::uint32_t, bool>> open;  // a node, and whether its operands are there
  for (auto result = computation.results.rbegin(); result != computation.results.rend(); ++result) {
    open.push_back({result->node(), false});
    while (!open.empty()) {
      const auto [node, is_next] = open.back();
      open.pop_back();
      if (is_next) order.push_back(node);
      if (is_next || begun[node]) continue;
      begun[node] = true;
      open.push_back({node, true});
      std::vector<std::uint32_t> operands = operands_of(dag.node(node));
      std::stable_sort(operands.begin(), operands.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return need[a] > need[b]; });
      for (auto operand = operands.rbegin(); operand != operands.rend(); ++operand) {
        open.push_back({*operand, false});
      }
    }
  }
  return order;
}

}  // namespace sinew::backend
