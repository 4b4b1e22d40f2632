// Machine code made in this process: a scalar data-flow graph is handed to LLVM and comes back as
// two functions. What they compute is what the generated C computes, with the instructions of this
// very machine.
//
// LLVM is loaded the first time that something is compiled, from a library of its own
// (libsinew_jit), so that a program which never compiles does not pay for it, and works where LLVM
// is not installed.
//
// Calling the functions is real-time safe: no allocation, no lock, a bounded number of
// instructions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "sinew/program/dag/dag.h"
#include "sinew/program/limbs/limb_program.h"
#include "sinew/program/scalar_program.h"

namespace sinew::backend {

enum class JitLevel : std::uint8_t {
  kFast,  // milliseconds to the first call
  kFull,  // the fastest code
};

struct JitOptions {
  JitLevel level = JitLevel::kFull;
  std::string
      cache_folder;  // compiled code is kept here under a hash of its content; empty: nowhere
};

class JitFunction {
 public:
  // in: computation.inputs numbers; out: computation.results.size() numbers. They may not overlap.
  void operator()(const double* in, double* out) const noexcept { single_(in, out); }
  // n samples: input i of sample k at in[i * n + k], result j of sample k at out[j * n + k]. A
  // sample's results are bit for bit the same wherever in a batch of whatever size it stands; and,
  // without limbs side by side, those of a single call.
  void batch(const double* in, double* out, std::size_t n) const noexcept;

  std::size_t code_bytes() const { return code_bytes_; }  // of the single-sample function
  std::size_t batch_code_bytes() const { return batch_code_bytes_; }  // of the block function
  bool from_cache() const { return from_cache_; }

  using Single = void (*)(const double*, double*);
  using Block = void (*)(const double*, double*, std::size_t stride);  // kLanes samples
  static constexpr std::size_t kLanes = 8;
  static constexpr std::size_t kMaximumWidth = 8192;  // inputs and results together

 private:
  friend struct JitFunctionMaker;
  Single single_ = nullptr;
  Single one_by_one_ = nullptr;  // single_, or without limbs side by side
  Block block_ = nullptr;
  std::size_t inputs_ = 0;
  std::size_t results_ = 0;
  std::size_t code_bytes_ = 0;
  std::size_t batch_code_bytes_ = 0;
  bool from_cache_ = false;
  std::shared_ptr<void> code_;  // owns the machine code
};

// True where libsinew_jit and LLVM can be loaded; otherwise `why` (if given) says what is missing.
bool jit_available(std::string* why = nullptr);

// Throws Error when the library cannot be loaded or LLVM refuses.
// With `limbs`, of the same program, single calls compute them side by side.
JitFunction jit_compile(const program::Computation& computation, const JitOptions& options = {},
                        const program::LimbProgram* limbs = nullptr);
// A program, with its limbs side by side where that pays.
JitFunction jit_compile(const program::ScalarProgram& program, const JitOptions& options = {});

}  // namespace sinew::backend
