// From the scalar data-flow graph to LLVM IR. The graph is optimised already, so the IR is
// straight-line code with explicit fused multiply-adds: what LLVM adds is instruction selection,
// scheduling and registers.
#pragma once

#include <llvm-c/Core.h>

#include <cstdint>

#include "sinew/backend/jit/entry.h"
#include "sinew/program/dag/dag.h"
#include "sinew/program/limbs/limb_program.h"

namespace sinew::backend {

inline constexpr const char* kSingleName = "sinew_single";
inline constexpr const char* kOneByOneName = "sinew_one_by_one";
inline constexpr const char* kBlockName = "sinew_block";
// See sincos.h.
inline constexpr const char* kSincosRepairName = "sinew_sincos_repair";

// What is compiled.
struct CodeSource {
  const program::Computation& computation;
  const program::LimbProgram* limbs = nullptr;  // null: none
  const JitWanted& wanted;
};

// Values that the function of one sample holds in registers; a few are left to the generator.
inline constexpr std::uint32_t kRegistersOf32 = 30;
inline constexpr std::uint32_t kRegistersOf16 = 15;

// What the machine can do.
struct EmitOptions {
  bool fuse = false;                         // products that are used once into fused multiply-adds
  bool broadcasts = false, indexes = false;  // see place.h
  std::uint32_t registers = kRegistersOf16;
};

// A module with
//   void sinew_single(const number* in, number* out)
// and, if it is wanted,
//   void sinew_one_by_one(const number* in, number* out)
// With limbs sinew_single computes them side by side; sinew_one_by_one does what the block does for
// one sample. They fuse the same products, so that both give the same bits.
LLVMModuleRef emit_samples(LLVMContextRef context, const CodeSource& source,
                           const EmitOptions& options);

// A module with
//   void sinew_block(const number* in, number* out, size_t stride)   as many samples as fit into 64
//   bytes: input i of sample k at in[i * stride + k], outputs likewise
struct BlockModule {
  LLVMModuleRef module = nullptr;
  bool is_planned = false;  // its registers are
};
// Plans registers where the machine can do what block_emitter.h needs; `always`: also for short
// functions, which LLVM's scheduler, as long as it has little to spill, makes up to 8 % faster.
BlockModule emit_block(LLVMContextRef context, const CodeSource& source, const EmitOptions& options,
                       bool always);

}  // namespace sinew::backend
