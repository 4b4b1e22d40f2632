#include "sinew/backend/jit/computation_emitter.h"

#include <algorithm>
#include <numeric>

#include "sinew/backend/jit/packed_sines.h"
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
                                       LLVMTypeRef type, Load load)
    : computation_(computation),
      dag_(computation.dag),
      builder_(place.builder),
      function_(place.function),
      repair_(place.repair),
      load_(std::move(load)),
      ir_(place.builder, type, place.fuse),
      fuse_(place.fuse),
      live_(program::live_nodes(computation)),
      uses_(dag_.size(), 0),
      values_(dag_.size(), nullptr),
      sine_(dag_.size(), nullptr),
      cosine_(dag_.size(), nullptr),
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

std::vector<LLVMValueRef> ComputationEmitter::emit(const Computed& computed) {
  emit_sines_of_inputs();
  std::vector<std::uint32_t> order = computation_.order;
  if (order.empty()) {
    order.resize(dag_.size());
    std::iota(order.begin(), order.end(), 0u);
  }
  for (const std::uint32_t index : order) {
    if (live_[index] && !is_fused(index)) computed(index, value(index));
  }
  std::vector<LLVMValueRef> results;
  for (const Ref result : computation_.results) results.push_back(signed_value(result));
  return results;
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

void ComputationEmitter::emit_sines_of_inputs() {
  std::vector<std::uint32_t> nodes = angles_that_are_inputs();
  std::erase_if(nodes, [this](std::uint32_t node) { return sine_[node] != nullptr; });
  if (nodes.empty()) return;
  if (ir_.lanes() >= kSineLanes) {
    std::vector<LLVMValueRef> angles;
    for (const std::uint32_t node : nodes) angles.push_back(ir_.to_double(value(node)));
    const SincosValues values = emit_sincos(builder_, function_, repair_, angles, fuse_);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      set_sine(nodes[i], values.sine[i], values.cosine[i]);
    }
    return;
  }
  const unsigned lanes = ir_.lanes();
  std::vector<LLVMValueRef> numbers;
  for (const std::uint32_t node : nodes) {
    for (unsigned lane = 0; lane < lanes; ++lane) {
      const LLVMValueRef at = LLVMConstInt(LLVMInt64TypeInContext(ir_.context()), lane, false);
      numbers.push_back(lanes == 1 ? value(node)
                                   : LLVMBuildExtractElement(builder_, value(node), at, ""));
    }
  }
  const PackedSines sines({builder_, function_, repair_, fuse_}, numbers);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    set_sine(nodes[i], sines.sine(i * lanes, lanes), sines.cosine(i * lanes, lanes));
  }
}

LLVMValueRef ComputationEmitter::signed_value(Ref ref) {
  const LLVMValueRef magnitude = value(ref.node());
  return ref.negative() ? ir_.negate(magnitude) : magnitude;
}

LLVMValueRef ComputationEmitter::value(std::uint32_t index) {
  LLVMValueRef& kept = values_[index];
  if (kept == nullptr) kept = compute(index);
  return kept;
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
      return load_(node.index);
    case Op::kAdd:
      return sum(node);
    case Op::kMultiply:
      return with_sign(ir_.multiply(value(node.a.node()), value(node.b.node())),
                       node.a.negative() != node.b.negative());
    case Op::kFma:
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
