#include "sinew/backend/jit/computation_emitter.h"

#include <algorithm>
#include <numeric>

#include "sinew/backend/jit/sincos.h"
#include "sinew/program/dag/evaluate.h"

namespace sinew::backend {

using program::Computation;
using program::Node;
using program::Op;
using program::Ref;

namespace {

bool is_trigonometric(Op op) { return op == Op::kSin || op == Op::kCos; }

}  // namespace

ComputationEmitter::ComputationEmitter(const Computation& computation, const Place& place,
                                       LLVMTypeRef type, Fetch fetch)
    : computation_(computation),
      dag_(computation.dag),
      builder_(place.builder),
      function_(place.function),
      repair_(place.repair),
      fetch_(std::move(fetch)),
      ir_(place.builder, type, place.fuse),
      fuse_(place.fuse),
      live_(program::live_nodes(computation)),
      uses_(dag_.size(), 0),
      values_(dag_.size(), nullptr),
      sine_(dag_.size(), nullptr),
      cosine_(dag_.size(), nullptr),
      fetched_(dag_.size(), false),
      fused_(dag_.size(), false) {
  count_uses();
}

std::vector<std::uint32_t> ComputationEmitter::angles_that_are_inputs() const {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < dag_.size(); ++i) {
    if (!live_[i] || !is_trigonometric(dag_.node(i).op)) continue;
    const std::uint32_t angle = dag_.node(i).a.node();
    if (dag_.node(angle).op == Op::kInput) nodes.push_back(angle);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

void ComputationEmitter::set_sine(std::uint32_t angle, LLVMValueRef sine, LLVMValueRef cosine) {
  sine_[angle] = ir_.from_double(sine);
  cosine_[angle] = ir_.from_double(cosine);
}

std::vector<std::uint32_t> ComputationEmitter::order() const {
  std::vector<std::uint32_t> order = computation_.order;
  if (order.empty()) {
    order.resize(dag_.size());
    std::iota(order.begin(), order.end(), 0u);
  }
  std::erase_if(order, [&](std::uint32_t node) { return !live_[node]; });
  return order;
}

bool ComputationEmitter::is_statement(std::uint32_t node) const {
  const Op op = dag_.node(node).op;
  return live_[node] && !fused_[node] && op != Op::kLess && !is_fetched(node);
}

bool ComputationEmitter::is_fetched(std::uint32_t node) const {
  const Node& of = dag_.node(node);
  return program::arity(of.op) == 0 || (is_trigonometric(of.op) && fetched_[of.a.node()]);
}

void ComputationEmitter::for_each_operand(
    std::uint32_t node, const std::function<void(std::uint32_t operand)>& visit) const {
  const Node& of = dag_.node(node);
  const Ref operands[] = {of.a, of.b, of.c};
  for (int k = 0; k < program::arity(of.op); ++k) {
    const std::uint32_t operand = operands[k].node();
    if (is_statement(operand) || is_fetched(operand)) {
      visit(operand);
    } else {
      for_each_operand(operand, visit);
    }
  }
}

void ComputationEmitter::count_uses() {
  for (std::uint32_t i = 0; i < dag_.size(); ++i) {
    if (!live_[i]) continue;
    const Node& node = dag_.node(i);
    const Ref operands[] = {node.a, node.b, node.c};
    for (int k = 0; k < program::arity(node.op); ++k) ++uses_[operands[k].node()];
  }
  for (const Ref result : computation_.results) ++uses_[result.node()];
  for (std::uint32_t i = 0; i < dag_.size(); ++i) {
    const Node& node = dag_.node(i);
    if (!live_[i] || node.op != Op::kAdd) continue;
    if (fuses_second(node)) fused_[node.b.node()] = true;
    if (fuses_first(node)) fused_[node.a.node()] = true;
  }
}

LLVMValueRef ComputationEmitter::signed_value(Ref ref) {
  const LLVMValueRef magnitude = value(ref.node());
  return ref.negative() ? ir_.negate(magnitude) : magnitude;
}

LLVMValueRef ComputationEmitter::value(std::uint32_t node) {
  LLVMValueRef& value = values_[node];
  if (value == nullptr) value = fetch_(node);
  if (value != nullptr) return value;
  const LLVMValueRef computed = compute(node);
  if (is_statement(node)) value = computed;
  return computed;
}

bool ComputationEmitter::is_product_of_one_use(Ref ref) const {
  return fuse_ && dag_.node(ref).op == Op::kMultiply && uses_[ref.node()] == 1;
}

bool ComputationEmitter::fuses_first(const Node& sum) const {
  return !fuses_second(sum) && is_product_of_one_use(sum.a);
}

LLVMValueRef ComputationEmitter::compute(std::uint32_t index) {
  const Node& node = dag_.node(index);
  switch (node.op) {
    case Op::kConstant:
      return ir_.number(node.value);
    case Op::kInput:
      return nullptr;  // always fetched
    case Op::kAdd:
      return sum(node);
    case Op::kMultiply:
      return with_sign(ir_.multiply(value(node.a.node()), value(node.b.node())),
                       node.a.negative() != node.b.negative());
    case Op::kFma:
      if (!fuse_ && node.a.negative() != node.b.negative() && !node.c.negative()) {
        return ir_.subtract(value(node.c.node()),
                            ir_.multiply(value(node.a.node()), value(node.b.node())));
      }
      return ir_.multiply_add(signed_value(node.a), signed_value(node.b), signed_value(node.c));
    case Op::kDivide:
      return with_sign(ir_.divide(value(node.a.node()), value(node.b.node())),
                       node.a.negative() != node.b.negative());
    case Op::kSqrt:
      return ir_.square_root(signed_value(node.a));
    case Op::kSin:
      emit_single_sine(node.a.node());
      return with_sign(sine_[node.a.node()], node.a.negative());
    case Op::kCos:
      emit_single_sine(node.a.node());
      return cosine_[node.a.node()];
    case Op::kLess:
      return ir_.less(signed_value(node.a), signed_value(node.b));
    case Op::kSelect:
      return ir_.select(value(node.a.node()), signed_value(node.b), signed_value(node.c));
  }
  return nullptr;
}

LLVMValueRef ComputationEmitter::with_sign(LLVMValueRef value, bool negative) {
  return negative ? ir_.negate(value) : value;
}

LLVMValueRef ComputationEmitter::sum(const Node& node) {
  const bool fuse_b = fuses_second(node);
  if (fuse_b || fuses_first(node)) {
    const Ref product = fuse_b ? node.b : node.a;
    const Ref other = fuse_b ? node.a : node.b;
    const Node& factors = dag_.node(product);
    const bool negative = product.negative() != (factors.a.negative() != factors.b.negative());
    return ir_.multiply_add(with_sign(value(factors.a.node()), negative), value(factors.b.node()),
                            signed_value(other));
  }
  if (node.a.negative() && !node.b.negative()) {
    return ir_.subtract(value(node.b.node()), value(node.a.node()));
  }
  if (node.b.negative()) return ir_.subtract(signed_value(node.a), value(node.b.node()));
  return ir_.add(value(node.a.node()), value(node.b.node()));
}

void ComputationEmitter::emit_single_sine(std::uint32_t angle) {
  if (sine_[angle] != nullptr) return;
  const SincosValues values =
      emit_sincos(builder_, function_, repair_, {ir_.to_double(value(angle))}, fuse_);
  sine_[angle] = ir_.from_double(values.sine[0]);
  cosine_[angle] = ir_.from_double(values.cosine[0]);
}

}  // namespace sinew::backend
