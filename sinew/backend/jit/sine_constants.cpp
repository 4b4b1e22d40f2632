#include "sinew/backend/jit/sine_constants.h"

#include "sinew/backend/jit/ir.h"

namespace sinew::backend {

SineConstants::SineConstants(const Place& place) : place_(place) {
  const LLVMModuleRef module = LLVMGetGlobalParent(place.function);
  number_ = LLVMInt64TypeInContext(LLVMGetModuleContext(module));
  begin_ = LLVMAddGlobal(module, number_, "sine_constants_begin");
  pointer_ = hidden(place.builder, begin_);
}

LLVMValueRef SineConstants::load(std::uint64_t bits, LLVMTypeRef type) {
  LLVMValueRef at = LLVMConstInt(number_, constants_.size(), false);
  constants_.push_back(LLVMConstInt(number_, bits, false));
  return LLVMBuildLoad2(place_.builder, type,
                        LLVMBuildGEP2(place_.builder, number_, pointer_, &at, 1, ""), "");
}

void SineConstants::end() { become_table(begin_, constants_, "sine_constants"); }

}  // namespace sinew::backend
