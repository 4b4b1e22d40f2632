#include "sinew/backend/c_flat_limb_steps.h"

#include <numeric>

namespace sinew::backend {

using program::LimbProgram;
using program::LimbRegion;
using program::LimbSource;
using program::Node;
using program::Op;
using program::Ref;

LimbNodes::LimbNodes(const LimbProgram& program) {
  first_.push_back(0);
  for (const LimbRegion& region : program.regions) {
    first_.push_back(first_.back() + region.computation.dag.size());
  }
}

std::vector<std::uint32_t> limb_order(const LimbRegion& region,
                                      const std::vector<std::uint8_t>& live) {
  std::vector<std::uint32_t> order = region.computation.order;
  if (order.empty()) {
    order.resize(region.computation.dag.size());
    std::iota(order.begin(), order.end(), 0U);
  }
  std::erase_if(order, [&](std::uint32_t i) {
    const Op op = region.computation.dag.node(i).op;
    return !live[i] || program::arity(op) == 0 || op == Op::kLess;
  });
  return order;
}

namespace {

class StepList {
 public:
  StepList(const LimbProgram& program, const LimbNodes& nodes)
      : program_(program), nodes_(nodes), steps_(nodes.size()), defined_(nodes.size(), false) {}

  ValueSteps run(const std::vector<std::vector<std::uint32_t>>& orders,
                 const std::vector<std::uint32_t>& later) {
    for (at_ = 0; at_ < program_.regions.size(); ++at_) {
      for (const std::uint32_t i : orders[at_]) step(i);
    }
    for (const std::uint32_t k : later) source(program_.results[k]);
    steps_.end();
    return std::move(steps_);
  }

 private:
  const LimbRegion& region() const { return program_.regions[at_]; }
  const Node& node(std::uint32_t i) const { return region().computation.dag.node(i); }

  void step(std::uint32_t i) {
    const Node& n = node(i);
    const int operands = program::arity(n.op);
    if (n.op == Op::kSelect) {
      operand(node(n.a.node()).a);
      operand(node(n.a.node()).b);
    } else {
      operand(n.a);
    }
    if (operands > 1) operand(n.b);
    if (operands > 2) operand(n.c);
    if (n.op != Op::kSin && n.op != Op::kCos) define(i);
    steps_.end();
  }

  void define(std::uint32_t i) {
    const std::uint32_t value = nodes_.of(at_, i);
    defined_[value] = true;
    steps_.define(value);
    steps_.set_width(value, static_cast<std::uint8_t>(program::vector_width(region().lanes)));
  }

  void operand(Ref ref) {
    const Node& n = node(ref.node());
    if (n.op == Op::kInput && !defined_[nodes_.of(at_, ref.node())]) {
      input(ref.node(), region().inputs[n.index]);
    } else if (defined_[nodes_.of(at_, ref.node())]) {
      steps_.read(nodes_.of(at_, ref.node()));
    }
  }

  // Plain numbers of the caller's lie in memory, constants need no register.
  void input(std::uint32_t i, const std::vector<LimbSource>& sources) {
    bool computed = false;
    for (const LimbSource& from : sources) {
      computed = computed || from.kind == LimbSource::Kind::kRegion ||
                 (from.kind == LimbSource::Kind::kCaller && region().lanes > 1);
      source(from);
    }
    if (computed) define(i);
  }

  void source(const LimbSource& from) {
    if (from.kind != LimbSource::Kind::kRegion) return;
    const LimbRegion& other = program_.regions[from.region];
    const Ref ref = other.computation.results[from.index];
    const Node& n = other.computation.dag.node(ref);
    if (n.op == Op::kInput) {
      source(other.inputs[n.index][from.lane]);
    } else if (const std::uint32_t value = nodes_.of(from.region, ref.node()); defined_[value]) {
      steps_.read(value);
    }
  }

  const LimbProgram& program_;
  const LimbNodes& nodes_;
  ValueSteps steps_;
  std::vector<bool> defined_;
  std::size_t at_ = 0;  // the region
};

}  // namespace

ValueSteps limb_steps(const LimbProgram& program, const LimbNodes& nodes,
                      const std::vector<std::vector<std::uint32_t>>& orders,
                      const std::vector<std::uint32_t>& later) {
  return StepList(program, nodes).run(orders, later);
}

}  // namespace sinew::backend
