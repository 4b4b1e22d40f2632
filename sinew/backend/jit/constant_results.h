// Results that are constants, written with as few stores as possible. A mass matrix or the
// Jacobians of several tips are mostly zeros: one store for each of them would take longer than
// what is computed, and LLVM joins neighbours only by looking at all pairs of them.
#pragma once

#include <llvm-c/Core.h>

#include <optional>
#include <vector>

namespace sinew::backend {

// Stores what has a value at its place in `out`, a pointer to numbers of the type. Blocks of zeros
// (zero_blocks.h) are loops, so that the builder goes on in another basic block.
void store_constant_results(LLVMBuilderRef builder, LLVMTypeRef number, LLVMValueRef out,
                            const std::vector<std::optional<double>>& results);

}  // namespace sinew::backend
