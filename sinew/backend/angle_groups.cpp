#include "sinew/backend/angle_groups.h"

#include <algorithm>

#include "sinew/program/dag/evaluate.h"

namespace sinew::backend {
namespace {

using program::Dag;
using program::Node;
using program::Op;

bool is_trigonometric(const Node& node) { return node.op == Op::kSin || node.op == Op::kCos; }

// For each node, how many sines lie on the deepest path to it.
std::vector<std::uint32_t> depths(const Dag& dag) {
  std::vector<std::uint32_t> depth(dag.size(), 0);
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    const Node& node = dag.node(i);
    const int operands = program::arity(node.op);
    if (operands > 0) depth[i] = std::max(depth[i], depth[node.a.node()]);
    if (operands > 1) depth[i] = std::max(depth[i], depth[node.b.node()]);
    if (operands > 2) depth[i] = std::max(depth[i], depth[node.c.node()]);
    if (is_trigonometric(node)) ++depth[i];
  }
  return depth;
}

void mark(const Dag& dag, std::uint32_t i, std::vector<bool>& marked) {
  std::vector<std::uint32_t> todo = {i};
  while (!todo.empty()) {
    const std::uint32_t at = todo.back();
    todo.pop_back();
    if (marked[at]) continue;
    marked[at] = true;
    const Node& node = dag.node(at);
    const int operands = program::arity(node.op);
    if (operands > 0) todo.push_back(node.a.node());
    if (operands > 1) todo.push_back(node.b.node());
    if (operands > 2) todo.push_back(node.c.node());
  }
}

}  // namespace

AngleGroups group_angles(const program::Computation& computation) {
  const Dag& dag = computation.dag;
  const std::vector<std::uint8_t> live = program::live_nodes(computation);
  std::vector<std::uint32_t> order;
  if (computation.order.empty()) {
    for (std::uint32_t i = 0; i < dag.size(); ++i) order.push_back(i);
  } else {
    order = computation.order;
  }
  const auto needs_statement = [&](std::uint32_t i) {
    const Op op = dag.node(i).op;
    return live[i] && program::arity(op) > 0 && op != Op::kLess;
  };

  AngleGroups result;
  const std::vector<std::uint32_t> depth = depths(dag);
  std::vector<std::uint32_t> position(dag.size(), AngleGroup::kNone);  // of an angle in its group
  for (const std::uint32_t i : order) {
    const Node& node = dag.node(i);
    if (!live[i] || !is_trigonometric(node)) continue;
    const std::uint32_t angle = node.a.node();
    const std::uint32_t level = depth[angle];
    if (result.groups.size() <= level) result.groups.resize(level + 1);
    AngleGroup& group = result.groups[level];
    if (position[angle] == AngleGroup::kNone) {
      position[angle] = 0;
      group.angles.push_back(angle);
    }
  }
  for (AngleGroup& group : result.groups) {
    // Inputs by their place, so that neighbours can be read at once.
    std::stable_sort(group.angles.begin(), group.angles.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       const Node& x = dag.node(a);
                       const Node& y = dag.node(b);
                       const bool x_is_input = x.op == Op::kInput;
                       const bool y_is_input = y.op == Op::kInput;
                       if (x_is_input != y_is_input) return x_is_input;
                       return x_is_input && x.index < y.index;
                     });
    for (std::uint32_t k = 0; k < group.angles.size(); ++k) position[group.angles[k]] = k;
    group.sines.assign(group.angles.size(), AngleGroup::kNone);
    group.cosines.assign(group.angles.size(), AngleGroup::kNone);
  }
  for (const std::uint32_t i : order) {
    const Node& node = dag.node(i);
    if (!live[i] || !is_trigonometric(node)) continue;
    AngleGroup& group = result.groups[depth[node.a.node()]];
    (node.op == Op::kSin ? group.sines : group.cosines)[position[node.a.node()]] = i;
  }

  std::vector<bool> done(dag.size(), false);
  for (AngleGroup& group : result.groups) {
    std::vector<bool> wanted = done;
    for (const std::uint32_t angle : group.angles) mark(dag, angle, wanted);
    for (const std::uint32_t i : order) {
      if (wanted[i] && !done[i] && needs_statement(i) && !is_trigonometric(dag.node(i))) {
        group.before.push_back(i);
      }
    }
    done = wanted;
  }
  for (const std::uint32_t i : order) {
    if (!done[i] && needs_statement(i) && !is_trigonometric(dag.node(i))) result.after.push_back(i);
  }
  return result;
}

}  // namespace sinew::backend
