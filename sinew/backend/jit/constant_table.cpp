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

void ConstantTable::end() { become_table(begin_, constants_, "sine_constants"); }

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

}  // namespace sinew::backend
