#include "sinew/backend/jit/constant_table.h"

#include "sinew/backend/jit/ir.h"

namespace sinew::backend {

ConstantTable::ConstantTable(const Place& place) : place_(place) {
  const LLVMModuleRef module = LLVMGetGlobalParent(place.function);
  number_ = LLVMInt64TypeInContext(LLVMGetModuleContext(module));
  begin_ = LLVMAddGlobal(module, number_, "sine_constants_begin");
  pointer_ = hidden(place.builder, begin_);
}

LLVMValueRef ConstantTable::load(std::uint64_t bits, LLVMTypeRef type) {
  LLVMValueRef at = LLVMConstInt(number_, constants_.size(), false);
  constants_.push_back(LLVMConstInt(number_, bits, false));
  return LLVMBuildLoad2(place_.builder, type,
                        LLVMBuildGEP2(place_.builder, number_, pointer_, &at, 1, ""), "");
}

void ConstantTable::end() {
  const LLVMValueRef list = LLVMConstArray2(number_, constants_.data(), constants_.size());
  const LLVMValueRef table =
      LLVMAddGlobal(LLVMGetGlobalParent(place_.function), LLVMTypeOf(list), "sine_constants");
  LLVMSetInitializer(table, list);
  LLVMSetGlobalConstant(table, true);
  LLVMSetLinkage(table, LLVMPrivateLinkage);
  LLVMReplaceAllUsesWith(begin_, table);
  LLVMDeleteGlobal(begin_);
}

}  // namespace sinew::backend
