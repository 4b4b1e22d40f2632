#include "sinew/backend/jit/emit.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <vector>

#include "sinew/backend/jit/ir.h"
#include "sinew/backend/jit/sincos.h"
#include "sinew/program/dag/evaluate.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::Dag;
using program::Node;
using program::Op;
using program::Ref;

bool is_trigonometric(Op op) { return op == Op::kSin || op == Op::kCos; }

// Emits one function: either for one sample, or for kBatchLanes samples at once.
class FunctionEmitter {
 public:
  FunctionEmitter(const Computation& computation, LLVMBuilderRef builder, LLVMValueRef function,
                  LLVMValueRef repair, LLVMTypeRef type, LLVMValueRef stride, bool fuse)
      : computation_(computation),
        dag_(computation.dag),
        builder_(builder),
        function_(function),
        repair_(repair),
        stride_(stride),
        ir_(builder, type, fuse),
        fuse_(fuse),
        live_(program::live_nodes(computation)),
        uses_(dag_.size(), 0),
        values_(dag_.size(), nullptr),
        sine_(dag_.size(), nullptr),
        cosine_(dag_.size(), nullptr),
        fused_(dag_.size(), false) {
    count_uses();
  }

  void emit() {
    emit_sines_of_inputs();
    std::vector<std::uint32_t> order = computation_.order;
    if (order.empty()) {
      order.resize(dag_.size());
      std::iota(order.begin(), order.end(), 0u);
    }
    for (const std::uint32_t index : order) {
      if (live_[index] && !is_fused(index)) (void)value(index);
    }
    for (std::size_t i = 0; i < computation_.results.size(); ++i) {
      store(signed_value(computation_.results[i]), i);
    }
    LLVMBuildRetVoid(builder_);
  }

 private:
  void count_uses() {
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

  LLVMValueRef address(LLVMValueRef base, std::size_t index) const {
    const LLVMTypeRef integer = LLVMInt64TypeInContext(ir_.context());
    LLVMValueRef offset = LLVMConstInt(integer, index, false);
    if (stride_ != nullptr) offset = LLVMBuildMul(builder_, offset, stride_, "");
    return LLVMBuildInBoundsGEP2(builder_, LLVMDoubleTypeInContext(ir_.context()), base, &offset, 1,
                                 "");
  }
  LLVMValueRef load(std::size_t index) const {
    const LLVMValueRef value =
        LLVMBuildLoad2(builder_, ir_.type(), address(LLVMGetParam(function_, 0), index), "");
    LLVMSetAlignment(value, 8);
    return value;
  }
  void store(LLVMValueRef value, std::size_t index) const {
    const LLVMValueRef done =
        LLVMBuildStore(builder_, value, address(LLVMGetParam(function_, 1), index));
    LLVMSetAlignment(done, 8);
  }

  // All angles that are inputs: one vectorised evaluation at the start. Angles that are computed
  // get theirs where they are needed.
  void emit_sines_of_inputs() {
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t i = 0; i < dag_.size(); ++i) {
      if (!live_[i] || !is_trigonometric(dag_.node(i).op)) continue;
      const std::uint32_t angle = dag_.node(i).a.node();
      if (dag_.node(angle).op == Op::kInput) nodes.push_back(angle);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    if (nodes.empty()) return;
    if (ir_.lanes() > 1) {
      std::vector<LLVMValueRef> angles;
      for (const std::uint32_t node : nodes) angles.push_back(value(node));
      const SincosValues values = emit_sincos(builder_, function_, repair_, angles, fuse_);
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        sine_[nodes[i]] = values.sine[i];
        cosine_[nodes[i]] = values.cosine[i];
      }
      return;
    }
    emit_packed_sines(nodes);
  }

  // One sample: angles share vectors of 8 (the last 4 or 2), unused lanes are 0.
  void emit_packed_sines(const std::vector<std::uint32_t>& nodes) {
    const LLVMTypeRef number = LLVMDoubleTypeInContext(ir_.context());
    const LLVMTypeRef integer = LLVMInt64TypeInContext(ir_.context());
    for (std::size_t first = 0; first < nodes.size();) {
      const std::size_t left = nodes.size() - first;
      const unsigned width = left > 4 ? 8 : left > 2 ? 4 : 2;
      const std::size_t count = std::min<std::size_t>(left, width);
      LLVMValueRef packed = LLVMConstNull(LLVMVectorType(number, width));
      for (std::size_t i = 0; i < count; ++i) {
        packed = LLVMBuildInsertElement(builder_, packed, value(nodes[first + i]),
                                        LLVMConstInt(integer, i, false), "");
      }
      const SincosValues values = emit_sincos(builder_, function_, repair_, {packed}, fuse_);
      for (std::size_t i = 0; i < count; ++i) {
        const LLVMValueRef lane = LLVMConstInt(integer, i, false);
        sine_[nodes[first + i]] = LLVMBuildExtractElement(builder_, values.sine[0], lane, "");
        cosine_[nodes[first + i]] = LLVMBuildExtractElement(builder_, values.cosine[0], lane, "");
      }
      first += count;
    }
  }

  LLVMValueRef signed_value(Ref ref) {
    const LLVMValueRef magnitude = value(ref.node());
    return ref.negative() ? ir_.negate(magnitude) : magnitude;
  }

  // Operands come first in the order, so this recursion is shallow.
  LLVMValueRef value(std::uint32_t index) {
    LLVMValueRef& kept = values_[index];
    if (kept == nullptr) kept = compute(index);
    return kept;
  }

  // A product that only one sum needs becomes part of that sum's fused multiply-add.
  bool is_product_of_one_use(Ref ref) const {
    return fuse_ && dag_.node(ref).op == Op::kMultiply && uses_[ref.node()] == 1;
  }
  // At most one operand of a sum is fused into it: the second where it can be.
  bool fuses_second(const Node& sum) const { return is_product_of_one_use(sum.b); }
  bool fuses_first(const Node& sum) const {
    return !fuses_second(sum) && is_product_of_one_use(sum.a);
  }
  bool is_fused(std::uint32_t index) const { return fused_[index]; }

  LLVMValueRef compute(std::uint32_t index) {
    const Node& node = dag_.node(index);
    switch (node.op) {
      case Op::kConstant:
        return ir_.number(node.value);
      case Op::kInput:
        return load(node.index);
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

  LLVMValueRef with_sign(LLVMValueRef value, bool negative) {
    return negative ? ir_.negate(value) : value;
  }

  LLVMValueRef sum(const Node& node) {
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

  void emit_single_sine(std::uint32_t angle) {
    if (sine_[angle] != nullptr) return;
    const SincosValues values = emit_sincos(builder_, function_, repair_, {value(angle)}, fuse_);
    sine_[angle] = values.sine[0];
    cosine_[angle] = values.cosine[0];
  }

  const Computation& computation_;
  const Dag& dag_;
  LLVMBuilderRef builder_;
  LLVMValueRef function_;
  LLVMValueRef repair_;
  LLVMValueRef stride_;  // null: one sample
  Ir ir_;
  bool fuse_;
  std::vector<bool> live_;
  std::vector<std::uint32_t> uses_;
  std::vector<LLVMValueRef> values_;  // by node
  std::vector<LLVMValueRef> sine_;    // by the angle's node
  std::vector<LLVMValueRef> cosine_;
  std::vector<bool> fused_;  // by node: part of the one sum that needs it
};

LLVMValueRef declare(LLVMModuleRef module, const char* name, std::vector<LLVMTypeRef> parameters) {
  const LLVMContextRef context = LLVMGetModuleContext(module);
  return LLVMAddFunction(module, name,
                         LLVMFunctionType(LLVMVoidTypeInContext(context), parameters.data(),
                                          static_cast<unsigned>(parameters.size()), false));
}

void add_attribute(LLVMValueRef function, unsigned where, const char* name) {
  const LLVMContextRef context = LLVMGetModuleContext(LLVMGetGlobalParent(function));
  const unsigned kind = LLVMGetEnumAttributeKindForName(name, std::strlen(name));
  LLVMAddAttributeAtIndex(function, where, LLVMCreateEnumAttribute(context, kind, 0));
}

}  // namespace

LLVMModuleRef emit_module(LLVMContextRef context, const program::Computation& computation,
                          bool fuse) {
  const LLVMModuleRef module = LLVMModuleCreateWithNameInContext("sinew", context);
  const LLVMTypeRef number = LLVMDoubleTypeInContext(context);
  const LLVMTypeRef pointer = LLVMPointerTypeInContext(context, 0);
  const LLVMTypeRef size = LLVMInt64TypeInContext(context);

  const LLVMValueRef repair = declare(module, kSincosRepairName, {pointer, pointer, pointer, size});
  const LLVMValueRef single = declare(module, kSingleName, {pointer, pointer});
  const LLVMValueRef block = declare(module, kBlockName, {pointer, pointer, size});

  const LLVMBuilderRef builder = LLVMCreateBuilderInContext(context);
  for (const LLVMValueRef function : {single, block}) {
    for (const unsigned parameter : {1u, 2u}) add_attribute(function, parameter, "noalias");
    add_attribute(function, LLVMAttributeFunctionIndex, "nounwind");
    LLVMPositionBuilderAtEnd(builder, LLVMAppendBasicBlockInContext(context, function, "entry"));
    const bool is_block = function == block;
    FunctionEmitter(computation, builder, function, repair,
                    is_block ? LLVMVectorType(number, kBatchLanes) : number,
                    is_block ? LLVMGetParam(function, 2) : nullptr, fuse)
        .emit();
  }
  LLVMDisposeBuilder(builder);
  return module;
}

}  // namespace sinew::backend
