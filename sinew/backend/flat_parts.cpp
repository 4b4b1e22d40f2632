#include "sinew/backend/flat_parts.h"

#include <algorithm>

namespace sinew::backend {
namespace {

using program::Node;
using program::Ref;

constexpr std::uint32_t kNowhere = 0xffffffffU;

}  // namespace

FlatParts divide_into_parts(const program::Computation& computation,
                            const std::vector<std::uint32_t>& before,
                            const std::vector<std::uint32_t>& nodes,
                            const std::vector<Ref>& last_read, std::size_t maximum) {
  const program::Dag& dag = computation.dag;
  FlatParts result;
  result.slot.assign(dag.size(), FlatParts::kNoSlot);
  if (nodes.size() <= maximum) return result;

  const std::size_t count = (nodes.size() + maximum - 1) / maximum;
  const std::size_t length = (nodes.size() + count - 1) / count;
  // Part 0 is the function itself; parts 1..count follow; the results are read after the last of
  // them.
  std::vector<std::uint32_t> home(dag.size(), kNowhere);
  std::vector<std::uint32_t> last(dag.size(), 0);  // part that reads it last
  for (const std::uint32_t node : before) home[node] = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i % length == 0) result.parts.emplace_back();
    result.parts.back().push_back(nodes[i]);
    home[nodes[i]] = static_cast<std::uint32_t>(result.parts.size());
  }
  const auto reads = [&](std::uint32_t part, std::uint32_t node) {
    last[node] = std::max(last[node], part);
  };
  for (const std::uint32_t i : nodes) {
    const auto visit = [&](const Node& node, const auto& self) -> void {
      const Ref operands[] = {node.a, node.b, node.c};
      for (int k = 0; k < program::arity(node.op); ++k) {
        reads(home[i], operands[k].node());
        // A condition has no statement of its own: its operands are read where it is used.
        const Node& operand = dag.node(operands[k]);
        if (operand.op == program::Op::kLess) self(operand, self);
      }
    };
    visit(dag.node(i), visit);
  }
  const auto end = static_cast<std::uint32_t>(result.parts.size() + 1);
  for (const Ref ref : last_read) reads(end, ref.node());

  // A slot is free again behind the part that reads it last.
  std::vector<std::vector<std::uint32_t>> freed(end + 1);
  std::vector<std::uint32_t> free;
  const auto keep = [&](std::uint32_t node) {
    if (last[node] <= home[node]) return;
    if (free.empty()) free.push_back(result.slots++);
    result.slot[node] = free.back();
    free.pop_back();
    freed[last[node]].push_back(result.slot[node]);
  };
  for (const std::uint32_t node : before) keep(node);
  for (std::uint32_t part = 1; part < end; ++part) {
    for (const std::uint32_t node : result.parts[part - 1]) keep(node);
    free.insert(free.end(), freed[part].begin(), freed[part].end());
  }
  return result;
}

}  // namespace sinew::backend
