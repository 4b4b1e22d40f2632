// From the scalar data-flow graph to LLVM IR. The graph is optimised already, so the IR is
// straight-line code with explicit fused multiply-adds: what LLVM adds is instruction selection,
// scheduling and registers.
#pragma once

#include <llvm-c/Core.h>

#include "sinew/backend/jit/entry.h"
#include "sinew/program/dag/dag.h"
#include "sinew/program/limbs/limb_program.h"

namespace sinew::backend {

inline constexpr const char* kSingleName = "sinew_single";
inline constexpr const char* kOneByOneName = "sinew_one_by_one";
inline constexpr const char* kBlockName = "sinew_block";
// void(const double* x, double* sine, double* cosine, size_t n): see sincos.h.
inline constexpr const char* kSincosRepairName = "sinew_sincos_repair";

// A module with
//   void sinew_single(const number* in, number* out)
// and, as far as they are wanted,
//   void sinew_block(const number* in, number* out, size_t stride)   as many samples as fit into 64
//   bytes: input i of sample k at in[i * stride + k], outputs likewise
//   void sinew_one_by_one(const number* in, number* out)
// With `limbs` (null: none) sinew_single computes them side by side; sinew_one_by_one does what the
// block does for one sample. `fuse` contracts products that are used once into fused
// multiply-adds, the same ones in both of them, so that both give the same bits.
LLVMModuleRef emit_module(LLVMContextRef context, const program::Computation& computation,
                          const program::LimbProgram* limbs, const JitWanted& wanted, bool fuse);

}  // namespace sinew::backend
