// Where code goes, for all that writes a function of LLVM IR.
#pragma once

#include <llvm-c/Core.h>

namespace sinew::backend {

struct Place {
  LLVMBuilderRef builder = nullptr;
  LLVMValueRef function = nullptr;
  LLVMValueRef repair = nullptr;  // see sincos.h
  bool fuse = false;              // products into sums
  bool broadcasts = false;  // instructions read one number from memory for all lanes of a vector
  bool indexes = false;     // addresses may be base + 1, 2, 4 or 8 times an index + one byte
};

// Bytes of a float or a double.
inline unsigned bytes_of(LLVMTypeRef number) {
  return LLVMGetTypeKind(number) == LLVMFloatTypeKind ? 4 : 8;
}

}  // namespace sinew::backend
