#include "sinew/backend/jit/ir.h"

#include <bit>
#include <cstring>
#include <utility>
#include <vector>

namespace sinew::backend {
namespace {

constexpr std::uint64_t kSign = std::uint64_t{1} << 63;

bool is_vector(LLVMTypeRef type) { return LLVMGetTypeKind(type) == LLVMVectorTypeKind; }

LLVMValueRef constant_in_every_lane(LLVMValueRef value, LLVMTypeRef type) {
  if (!is_vector(type)) return value;
  std::vector<LLVMValueRef> values(LLVMGetVectorSize(type), value);
  return LLVMConstVector(values.data(), static_cast<unsigned>(values.size()));
}

}  // namespace

// An instruction that is empty.
LLVMValueRef hidden(LLVMBuilderRef builder, LLVMValueRef pointer) {
  static constexpr char kSameRegister[] = "=r,0";
  LLVMTypeRef of = LLVMTypeOf(pointer);
  const LLVMTypeRef type = LLVMFunctionType(of, &of, 1, false);
  const LLVMValueRef nothing =
      LLVMGetInlineAsm(type, "", 0, kSameRegister, sizeof kSameRegister - 1, false, false,
                       LLVMInlineAsmDialectATT, false);
  return LLVMBuildCall2(builder, type, nothing, &pointer, 1, "");
}

LLVMValueRef become_table(LLVMValueRef begin, std::vector<LLVMValueRef>& numbers,
                          const char* name) {
  const LLVMTypeRef number = LLVMGlobalGetValueType(begin);
  const LLVMValueRef list = LLVMConstArray2(number, numbers.data(), numbers.size());
  const LLVMValueRef table = LLVMAddGlobal(LLVMGetGlobalParent(begin), LLVMTypeOf(list), name);
  LLVMSetInitializer(table, list);
  LLVMSetGlobalConstant(table, true);
  LLVMSetLinkage(table, LLVMPrivateLinkage);
  LLVMReplaceAllUsesWith(begin, table);
  LLVMDeleteGlobal(begin);
  return table;
}

Ir::Ir(LLVMBuilderRef builder, LLVMTypeRef type, bool fuse, LoadConstant constant)
    : builder_(builder),
      context_(LLVMGetTypeContext(type)),
      type_(type),
      element_type_(is_vector(type) ? LLVMGetElementType(type) : type),
      lanes_(is_vector(type) ? LLVMGetVectorSize(type) : 1),
      fuse_(fuse),
      constant_(std::move(constant)) {
  const LLVMTypeRef integer64 = LLVMInt64TypeInContext(context_);
  integer_type_ = is_vector(type) ? LLVMVectorType(integer64, lanes_) : integer64;
}

LLVMValueRef Ir::in_every_lane(LLVMValueRef lane) const {
  if (lanes_ == 1) return lane;
  const LLVMTypeRef index = LLVMInt32TypeInContext(context_);
  const LLVMValueRef undefined = LLVMGetUndef(LLVMVectorType(LLVMTypeOf(lane), lanes_));
  const LLVMValueRef first =
      LLVMBuildInsertElement(builder_, undefined, lane, LLVMConstInt(index, 0, false), "");
  return LLVMBuildShuffleVector(builder_, first, undefined,
                                LLVMConstNull(LLVMVectorType(index, lanes_)), "");
}

LLVMValueRef Ir::load_in_every_lane(std::uint64_t bits, LLVMTypeRef lane) const {
  return in_every_lane(constant_(bits, lane));
}

LLVMValueRef Ir::number(double value) const {
  if (constant_) return load_in_every_lane(std::bit_cast<std::uint64_t>(value), element_type_);
  return constant_in_every_lane(LLVMConstReal(element_type_, value), type_);
}

LLVMValueRef Ir::to_double(LLVMValueRef a) const {
  const LLVMTypeRef number = LLVMDoubleTypeInContext(context_);
  if (element_type_ == number) return a;
  return LLVMBuildFPExt(builder_, a, lanes_ == 1 ? number : LLVMVectorType(number, lanes_), "");
}

LLVMValueRef Ir::from_double(LLVMValueRef a) const {
  if (element_type_ == LLVMDoubleTypeInContext(context_)) return a;
  return LLVMBuildFPTrunc(builder_, a, type_, "");
}

LLVMValueRef Ir::integer(std::uint64_t value) const {
  if (constant_) return load_in_every_lane(value, LLVMInt64TypeInContext(context_));
  return constant_in_every_lane(LLVMConstInt(LLVMInt64TypeInContext(context_), value, false),
                                type_);
}

LLVMValueRef Ir::add(LLVMValueRef a, LLVMValueRef b) const {
  return LLVMBuildFAdd(builder_, a, b, "");
}
LLVMValueRef Ir::subtract(LLVMValueRef a, LLVMValueRef b) const {
  return LLVMBuildFSub(builder_, a, b, "");
}
LLVMValueRef Ir::multiply(LLVMValueRef a, LLVMValueRef b) const {
  return LLVMBuildFMul(builder_, a, b, "");
}
LLVMValueRef Ir::divide(LLVMValueRef a, LLVMValueRef b) const {
  const bool half_a_register = lanes_ == 2 && LLVMGetTypeKind(element_type_) == LLVMFloatTypeKind;
  if (!half_a_register) return LLVMBuildFDiv(builder_, a, b, "");
  // One by one: in the other half LLVM would divide nothing by nothing, which raises a flag.
  LLVMValueRef result = LLVMGetUndef(type_);
  for (unsigned k = 0; k < lanes_; ++k) {
    const LLVMValueRef lane = LLVMConstInt(LLVMInt64TypeInContext(context_), k, false);
    const LLVMValueRef quotient =
        LLVMBuildFDiv(builder_, LLVMBuildExtractElement(builder_, a, lane, ""),
                      LLVMBuildExtractElement(builder_, b, lane, ""), "");
    result = LLVMBuildInsertElement(builder_, result, quotient, lane, "");
  }
  return result;
}
LLVMValueRef Ir::negate(LLVMValueRef a) const { return LLVMBuildFNeg(builder_, a, ""); }

LLVMValueRef Ir::intrinsic(const char* name, LLVMValueRef* arguments, unsigned count) const {
  const unsigned id = LLVMLookupIntrinsicID(name, std::strlen(name));
  const LLVMModuleRef module =
      LLVMGetGlobalParent(LLVMGetBasicBlockParent(LLVMGetInsertBlock(builder_)));
  LLVMTypeRef overload = type_;
  const LLVMValueRef function = LLVMGetIntrinsicDeclaration(module, id, &overload, 1);
  const LLVMTypeRef type = LLVMIntrinsicGetType(context_, id, &overload, 1);
  return LLVMBuildCall2(builder_, type, function, arguments, count, "");
}

LLVMValueRef Ir::square_root(LLVMValueRef a) const { return intrinsic("llvm.sqrt", &a, 1); }

LLVMValueRef Ir::multiply_add(LLVMValueRef a, LLVMValueRef b, LLVMValueRef c) const {
  if (!fuse_) return add(multiply(a, b), c);
  LLVMValueRef arguments[] = {a, b, c};
  return intrinsic("llvm.fma", arguments, 3);
}

LLVMValueRef Ir::less(LLVMValueRef a, LLVMValueRef b) const {
  return LLVMBuildFCmp(builder_, LLVMRealOLT, a, b, "");
}
LLVMValueRef Ir::select(LLVMValueRef mask, LLVMValueRef if_true, LLVMValueRef if_false) const {
  return LLVMBuildSelect(builder_, mask, if_true, if_false, "");
}

LLVMValueRef Ir::to_integer_bits(LLVMValueRef a) const {
  return LLVMBuildBitCast(builder_, a, integer_type_, "");
}
LLVMValueRef Ir::add_integer(LLVMValueRef bits, std::uint64_t value) const {
  return LLVMBuildAdd(builder_, bits, integer(value), "");
}
LLVMValueRef Ir::bit_is_set(LLVMValueRef bits, unsigned bit) const {
  const LLVMValueRef masked = LLVMBuildAnd(builder_, bits, integer(std::uint64_t{1} << bit), "");
  return LLVMBuildICmp(builder_, LLVMIntNE, masked, LLVMConstNull(integer_type_), "");
}
LLVMValueRef Ir::shift_left(LLVMValueRef bits, unsigned places) const {
  const LLVMTypeRef type = LLVMInt64TypeInContext(context_);
  return LLVMBuildShl(builder_, bits,
                      constant_in_every_lane(LLVMConstInt(type, places, false), type_), "");
}
LLVMValueRef Ir::flip_sign(LLVMValueRef a, LLVMValueRef bits) const {
  const LLVMValueRef sign = LLVMBuildAnd(builder_, bits, integer(kSign), "");
  return LLVMBuildBitCast(builder_, LLVMBuildXor(builder_, to_integer_bits(a), sign, ""), type_,
                          "");
}
LLVMValueRef Ir::magnitude(LLVMValueRef a) const {
  const LLVMValueRef bits = LLVMBuildAnd(builder_, to_integer_bits(a), integer(~kSign), "");
  return LLVMBuildBitCast(builder_, bits, type_, "");
}
LLVMValueRef Ir::magnitude_at_most(LLVMValueRef a, double limit) const {
  return LLVMBuildFCmp(builder_, LLVMRealOLE, magnitude(a), number(limit), "");
}

LLVMValueRef Ir::all(LLVMValueRef mask) const {
  if (lanes_ == 1) return mask;
  const LLVMTypeRef bits = LLVMIntTypeInContext(context_, lanes_);
  const LLVMValueRef packed = LLVMBuildBitCast(builder_, mask, bits, "");
  return LLVMBuildICmp(builder_, LLVMIntEQ, packed, LLVMConstAllOnes(bits), "");
}

LLVMValueRef Ir::entry_array(LLVMValueRef function, std::size_t n) const {
  const LLVMBuilderRef at_entry = LLVMCreateBuilderInContext(context_);
  const LLVMBasicBlockRef entry = LLVMGetEntryBasicBlock(function);
  LLVMPositionBuilderBefore(at_entry, LLVMGetFirstInstruction(entry));
  const LLVMValueRef array =
      LLVMBuildAlloca(at_entry, LLVMArrayType(type_, static_cast<unsigned>(n)), "");
  LLVMDisposeBuilder(at_entry);
  return array;
}

LLVMValueRef Ir::element(LLVMValueRef array, std::size_t index) const {
  LLVMValueRef at = LLVMConstInt(LLVMInt64TypeInContext(context_), index, false);
  return LLVMBuildInBoundsGEP2(builder_, type_, array, &at, 1, "");
}
void Ir::store_element(LLVMValueRef value, LLVMValueRef array, std::size_t index) const {
  LLVMBuildStore(builder_, value, element(array, index));
}
LLVMValueRef Ir::load_element(LLVMValueRef array, std::size_t index) const {
  return LLVMBuildLoad2(builder_, type_, element(array, index), "");
}

}  // namespace sinew::backend
