// Compiles generated C with the system's C compiler and loads it into this process. For development
// and tests, and for `sinew run` where there is no JIT; it needs a compiler on the machine.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "sinew/backend/c_target.h"

namespace sinew::backend {

struct CompileOptions {
  std::string compiler = "cc";  // found on PATH, or a path; the environment's CC is not read
  std::vector<std::string> flags = {"-O2", "-march=native"};
  std::vector<std::string> libraries;  // files to link, for example libsinew_math.a
};

// A compiled function. The code stays loaded for as long as the object lives.
class LoadedCode {
 public:
  using Function = void (*)(const double* in, double* out);
  using StatefulFunction = void (*)(const double* in, double* out, double* state);
  using Batch = void (*)(const double* in, double* out, std::size_t n);
  using StatefulBatch = void (*)(const double* in, double* out, double* state, std::size_t n);

  LoadedCode(LoadedCode&&) noexcept;
  LoadedCode& operator=(LoadedCode&&) noexcept;
  ~LoadedCode();

  // Of a program without states.
  Function function() const { return reinterpret_cast<Function>(function_); }
  Batch batch() const { return reinterpret_cast<Batch>(batch_); }
  // Of a program with states.
  StatefulFunction stateful_function() const {
    return reinterpret_cast<StatefulFunction>(function_);
  }
  StatefulBatch stateful_batch() const { return reinterpret_cast<StatefulBatch>(batch_); }
  // Any function of the code by its name, or nullptr: NAME_update, functions on floats.
  void* find(const char* name) const;
  // Machine code, constants included [bytes].
  std::size_t code_bytes() const { return code_bytes_; }

 private:
  friend LoadedCode compile_and_load(const GeneratedCode&, const CompileOptions&);
  LoadedCode() = default;

  void* library_ = nullptr;
  void* function_ = nullptr;
  void* batch_ = nullptr;
  std::size_t code_bytes_ = 0;
};

// Throws Error with what the compiler says if there is none or if it fails.
LoadedCode compile_and_load(const GeneratedCode& code, const CompileOptions& options = {});

}  // namespace sinew::backend
