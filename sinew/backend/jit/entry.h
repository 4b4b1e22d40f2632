// The one function of libsinew_jit that the rest of Sinew calls.
#pragma once

#include "sinew/backend/jit.h"

namespace sinew::backend {

// Which functions, on which numbers.
struct JitWanted {
  bool is_float = false;
  bool block = true;
  bool one_by_one = false;  // besides `single`, where that has its limbs side by side
};

using JitCompile = void(const program::Computation& computation, const program::LimbProgram* limbs,
                        const JitOptions& options, const JitWanted& wanted, JitCode& result);
// The build adds a digest of the declarations on both sides (CMakeLists.txt).
#define SINEW_JIT_TEXT(name) #name
#define SINEW_JIT_NAME(name) SINEW_JIT_TEXT(name)
inline constexpr const char* kJitEntryName = SINEW_JIT_NAME(SINEW_JIT_COMPILE);

}  // namespace sinew::backend
