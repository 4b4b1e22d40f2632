// How LLVM's code generator is set up for straight-line code of thousands of operations.
#pragma once

#include "sinew/backend/jit.h"

namespace sinew::backend {

// Once in a process, before anything is compiled. Only where LLVM is part of this library are its
// options ours to set; with a shared LLVM it does nothing.
void set_up_code_generator();

// For as long as it lives, what this thread compiles gets its registers in the way of the level:
// kFull by LLVM's greedy allocator, which takes more than half of the time of a compilation, kFast
// by the basic one.
class RegisterAllocation {
 public:
  explicit RegisterAllocation(JitLevel level);
  ~RegisterAllocation();
  RegisterAllocation(const RegisterAllocation&) = delete;
  RegisterAllocation& operator=(const RegisterAllocation&) = delete;
};

}  // namespace sinew::backend
