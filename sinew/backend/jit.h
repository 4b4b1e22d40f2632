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
  kFast,  // the first call sooner; batches may take longer, without AVX-512 up to twice as long
  kFull,  // the fastest code
};

struct JitOptions {
  JitLevel level = JitLevel::kFull;
  // Compiled code is kept here, under a hash of the program, the processor and this build of the
  // compiler; empty: nowhere. Processes may share the folder. What is damaged there, or may have
  // been written by another user, is compiled again and not run.
  std::string cache_folder;
  // Without it only the function of one sample is compiled, in less than half the time; a batch
  // calls it sample by sample.
  bool batch = true;
};

// What the compiler hands back: functions on numbers of one type.
struct JitCode {
  void* single = nullptr;
  void* one_by_one =
      nullptr;            // one sample by the block's operations; single, or null if not needed
  void* block = nullptr;  // null without a batch
  std::size_t code_bytes = 0;
  std::size_t batch_code_bytes = 0;
  bool from_cache = false;
  std::shared_ptr<void> owner;  // of the machine code
};

// Of a function that calls machine code: -fsanitize=function looks for the type of what is called
// in the bytes before it, which belong to nobody here.
#ifdef __clang__
#define SINEW_CALLS_MACHINE_CODE [[clang::no_sanitize("function")]]
#else
#define SINEW_CALLS_MACHINE_CODE
#endif

// `Number` is double or float. Of float all numbers are, but for sines and cosines, which are
// computed in double and rounded once, as in generated C.
template <typename Number>
class BasicJitFunction {
 public:
  // in: computation.inputs numbers; out: computation.results.size() numbers. They may not overlap.
  SINEW_CALLS_MACHINE_CODE void operator()(const Number* in, Number* out) const noexcept {
    single_(in, out);
  }
  // n samples: input i of sample k at in[i * n + k], result j of sample k at out[j * n + k]. A
  // sample's results are bit for bit the same wherever in a batch of whatever size it stands; and,
  // without limbs side by side, those of a single call.
  SINEW_CALLS_MACHINE_CODE void batch(const Number* in, Number* out, std::size_t n) const noexcept;

  std::size_t code_bytes() const { return code_.code_bytes; }  // of the single-sample function
  std::size_t batch_code_bytes() const { return code_.batch_code_bytes; }  // of the block function
  bool from_cache() const { return code_.from_cache; }

  using Single = void (*)(const Number*, Number*);
  using Block = void (*)(const Number*, Number*, std::size_t stride);  // kLanes samples
  static constexpr std::size_t kLanes = 64 / sizeof(Number);
  static constexpr std::size_t kMaximumWidth = 8192;  // inputs and results together

  // Batches of fewer than kLanes samples are copied into a block of their own as long as that
  // needs no more than kMaximumWidth numbers on the stack.
  static constexpr bool fits_a_block(std::size_t width) { return width * kLanes <= kMaximumWidth; }

 private:
  friend struct JitFunctionMaker;
  Single single_ = nullptr;
  Single one_by_one_ = nullptr;
  Block block_ = nullptr;
  std::size_t inputs_ = 0;
  std::size_t results_ = 0;
  JitCode code_;
};

using JitFunction = BasicJitFunction<double>;
using JitFloatFunction = BasicJitFunction<float>;

// True where libsinew_jit and LLVM can be loaded; otherwise `why` (if given) says what is missing.
bool jit_available(std::string* why = nullptr);

// Throws Error when the library cannot be loaded or LLVM refuses.
// With `limbs`, of the same program, single calls compute them side by side.
JitFunction jit_compile(const program::Computation& computation, const JitOptions& options = {},
                        const program::LimbProgram* limbs = nullptr);
// A program, with its limbs side by side where that pays.
JitFunction jit_compile(const program::ScalarProgram& program, const JitOptions& options = {});

// The same on floats. Throws Error also for a constant that a float cannot hold.
JitFloatFunction jit_compile_float(const program::Computation& computation,
                                   const JitOptions& options = {},
                                   const program::LimbProgram* limbs = nullptr);
JitFloatFunction jit_compile_float(const program::ScalarProgram& program,
                                   const JitOptions& options = {});

}  // namespace sinew::backend
