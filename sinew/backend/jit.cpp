#include "sinew/backend/jit.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "sinew/backend/jit/entry.h"
#include "sinew/base/error.h"

namespace sinew::backend {
namespace {

namespace fs = std::filesystem;

// Where libsinew_jit may lie: named by the environment, beside the program, in its library folder,
// or where the build put it.
std::vector<fs::path> candidates() {
  std::vector<fs::path> paths;
  if (const char* named = std::getenv("SINEW_JIT_LIBRARY")) paths.emplace_back(named);
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
    library.fault = path.string() + " has no " + kJitEntryName;
  }
  if (library.fault.empty()) library.fault = "libsinew_jit.so is not there";
  return library;
}

const Library& library() {
  static const Library loaded = load();
  return loaded;
}

}  // namespace

void JitFunction::batch(const double* in, double* out, std::size_t n) const noexcept {
  std::size_t k = 0;
  for (; k + kLanes <= n; k += kLanes) block_(in + k, out + k, n);
  // What is left over goes one by one; jit_compile has checked that a sample fits.
  double sample[kMaximumWidth];
  double* const results = sample + inputs_;
  for (; k < n; ++k) {
    for (std::size_t i = 0; i < inputs_; ++i) sample[i] = in[i * n + k];
    one_by_one_(sample, results);
    for (std::size_t j = 0; j < results_; ++j) out[j * n + k] = results[j];
  }
}

bool jit_available(std::string* why) {
  if (why != nullptr) *why = library().fault;
  return library().compile != nullptr;
}

JitFunction jit_compile(const program::Computation& computation, const JitOptions& options,
                        const program::LimbProgram* limbs) {
  if (library().compile == nullptr) {
    throw Error({{},
                 "",
                 "code cannot be compiled in this process: " + library().fault,
                 "build with LLVM 19 installed (llvm-19-dev), or interpret",
                 Severity::kError,
                 {}});
  }
  const std::size_t width = computation.inputs + computation.results.size();
  if (width > JitFunction::kMaximumWidth) {
    throw Error({{},
                 "",
                 fmt::format("{} inputs and results are too many for one function", width),
                 fmt::format("ask for at most {}", JitFunction::kMaximumWidth),
                 Severity::kError,
                 {}});
  }
  JitFunction function;
  library().compile(computation, limbs, options, function);
  return function;
}

JitFunction jit_compile(const program::ScalarProgram& program, const JitOptions& options) {
  if (!program.program.derivatives.empty() || !program.update.results.empty()) {
    return jit_compile(program.computation, options);
  }
  const auto limbs =
      program::limb_program(program.program, program::count_operations(program.computation));
  return jit_compile(program.computation, options, limbs ? &*limbs : nullptr);
}

}  // namespace sinew::backend
