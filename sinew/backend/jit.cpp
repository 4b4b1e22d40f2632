#include "sinew/backend/jit.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sinew/backend/c_flat_body.h"
#include "sinew/backend/jit/entry.h"
#include "sinew/base/error.h"
#include "sinew/program/dag/evaluate.h"

namespace sinew::backend {
namespace {

namespace fs = std::filesystem;

// Where libsinew_jit may lie: where the environment says, and there alone; else beside the program,
// in its library folder, or where the build put it.
std::vector<fs::path> candidates() {
  std::vector<fs::path> paths;
  if (const char* named = std::getenv("SINEW_JIT_LIBRARY")) return {named};
  std::error_code fault;
  const fs::path program = fs::read_symlink("/proc/self/exe", fault);
  if (!fault) {
    paths.push_back(program.parent_path() / "libsinew_jit.so");
    paths.push_back(program.parent_path().parent_path() / SINEW_JIT_INSTALL_FOLDER /
                    "libsinew_jit.so");
  }
  paths.emplace_back(SINEW_JIT_BUILD_PATH);
  return paths;
}

struct Library {
  JitCompile* compile = nullptr;
  std::string fault;
};

Library load() {
  Library library;
  for (const fs::path& path : candidates()) {
    if (!fs::exists(path)) continue;
    // The handle is kept for the life of the process: compiled code may run until the end.
    void* handle = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (handle == nullptr) {
      library.fault = dlerror();
      continue;
    }
    library.compile = reinterpret_cast<JitCompile*>(dlsym(handle, kJitEntryName));
    if (library.compile != nullptr) return library;
    library.fault = path.string() + " belongs to another version (it has no " + kJitEntryName +
                    "); build or install both together";
  }
  if (library.fault.empty()) {
    const char* named = std::getenv("SINEW_JIT_LIBRARY");
    library.fault = std::string(named != nullptr ? named : "libsinew_jit.so") + " is not there";
  }
  return library;
}

const Library& library() {
  static const Library loaded = load();
  return loaded;
}

}  // namespace

struct JitFunctionMaker {
  template <typename Number>
  static BasicJitFunction<Number> make(JitCode code, const program::Computation& computation) {
    using Function = BasicJitFunction<Number>;
    Function function;
    function.single_ = reinterpret_cast<typename Function::Single>(code.single);
    function.one_by_one_ = reinterpret_cast<typename Function::Single>(code.one_by_one);
    function.block_ = reinterpret_cast<typename Function::Block>(code.block);
    function.inputs_ = computation.inputs;
    function.results_ = computation.results.size();
    function.code_ = std::move(code);
    return function;
  }
};

template <typename Number>
void BasicJitFunction<Number>::batch(const Number* in, Number* out, std::size_t n) const noexcept {
  std::size_t k = 0;
  if (block_ != nullptr) {
    for (; k + kLanes <= n; k += kLanes) block_(in + k, out + k, n);
    if (k == n) return;
    if (n >= kLanes) {
      // The last block again, further behind: what it computes twice it computes alike.
      block_(in + n - kLanes, out + n - kLanes, n);
      return;
    }
  }
  Number room[kMaximumWidth];  // jit_compile has checked that a sample fits
  if (block_ != nullptr && fits_a_block(inputs_ + results_)) {
    // Lanes that are left over repeat the first sample.
    Number* const results = room + inputs_ * kLanes;
    for (std::size_t i = 0; i < inputs_; ++i) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        room[i * kLanes + lane] = in[i * n + (lane < n ? lane : 0)];
      }
    }
    block_(room, results, kLanes);
    for (std::size_t j = 0; j < results_; ++j) {
      for (k = 0; k < n; ++k) out[j * n + k] = results[j * kLanes + k];
    }
    return;
  }
  Number* const results = room + inputs_;
  for (; k < n; ++k) {
    for (std::size_t i = 0; i < inputs_; ++i) room[i] = in[i * n + k];
    one_by_one_(room, results);
    for (std::size_t j = 0; j < results_; ++j) out[j * n + k] = results[j];
  }
}

template class BasicJitFunction<double>;
template class BasicJitFunction<float>;

bool jit_available(std::string* why) {
  if (why != nullptr) *why = library().fault;
  return library().compile != nullptr;
}

namespace {

template <typename Number>
BasicJitFunction<Number> compile(const program::Computation& computation, const JitOptions& options,
                                 const program::LimbProgram* limbs) {
  using Function = BasicJitFunction<Number>;
  if (library().compile == nullptr) {
    throw Error({{},
                 "",
                 "code cannot be compiled in this process: " + library().fault,
                 "build with LLVM 19 installed (llvm-19-dev), or interpret",
                 Severity::kError,
                 {}});
  }
  const std::size_t width = computation.inputs + computation.results.size();
  if (width > Function::kMaximumWidth) {
    throw Error({{},
                 "",
                 fmt::format("{} inputs and results are too many for one function", width),
                 fmt::format("ask for at most {}", Function::kMaximumWidth),
                 Severity::kError,
                 {}});
  }
  JitCode code;
  const JitWanted wanted{
      .is_float = sizeof(Number) == sizeof(float),
      .block = options.batch,
      .one_by_one = options.batch && limbs != nullptr && !Function::fits_a_block(width)};
  library().compile(computation, limbs, options, wanted, code);
  return JitFunctionMaker::make<Number>(std::move(code), computation);
}

// With its limbs side by side where that pays.
template <typename Number>
BasicJitFunction<Number> compile(const program::ScalarProgram& program, const JitOptions& options) {
  std::optional<program::LimbProgram> limbs;
  if (program.program.derivatives.empty() && program.update.results.empty()) {
    limbs = program::limb_program(program.program, program::count_operations(program.computation));
  }
  return compile<Number>(program.computation, options, limbs ? &*limbs : nullptr);
}

void check_floats(const program::Computation& computation) {
  const std::vector<std::uint8_t> live = program::live_nodes(computation);
  for (std::uint32_t i = 0; i < computation.dag.size(); ++i) {
    const program::Node& node = computation.dag.node(i);
    if (live[i] && node.op == program::Op::kConstant) {
      static_cast<void>(scalar_number(node.value, Scalar::kFloat));
    }
  }
}

}  // namespace

JitFunction jit_compile(const program::Computation& computation, const JitOptions& options,
                        const program::LimbProgram* limbs) {
  return compile<double>(computation, options, limbs);
}

JitFunction jit_compile(const program::ScalarProgram& program, const JitOptions& options) {
  return compile<double>(program, options);
}

JitFloatFunction jit_compile_float(const program::Computation& computation,
                                   const JitOptions& options, const program::LimbProgram* limbs) {
  check_floats(computation);
  return compile<float>(computation, options, limbs);
}

JitFloatFunction jit_compile_float(const program::ScalarProgram& program,
                                   const JitOptions& options) {
  check_floats(program.computation);
  return compile<float>(program, options);
}

}  // namespace sinew::backend
