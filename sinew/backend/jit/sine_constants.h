// The constants of sines, in a table behind a pointer of its own: an instruction takes one number
// from there for all lanes, with an address of one byte.
#pragma once

#include <llvm-c/Core.h>

#include <cstdint>
#include <vector>

#include "sinew/backend/jit/place.h"

namespace sinew::backend {

class SineConstants {
 public:
  explicit SineConstants(const Place& place);
  // A load. A place for each use, so that LLVM does not hold it in a register for the next one.
  LLVMValueRef load(std::uint64_t bits, LLVMTypeRef type);
  void end();

 private:
  const Place& place_;
  LLVMTypeRef number_;
  LLVMValueRef begin_, pointer_;  // `begin_` stands for the table until it is known
  std::vector<LLVMValueRef> constants_;
};

}  // namespace sinew::backend
