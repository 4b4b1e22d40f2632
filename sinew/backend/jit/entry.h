// The one function of libsinew_jit that the rest of Sinew calls.
#pragma once

#include "sinew/backend/jit.h"

namespace sinew::backend {

using JitCompile = void(const program::Computation& computation, const program::LimbProgram* limbs,
                        const JitOptions& options, JitFunction& result);
inline constexpr const char* kJitEntryName = "sinew_jit_compile";

}  // namespace sinew::backend
