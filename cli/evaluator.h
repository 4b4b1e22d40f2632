// A program made ready to run, whichever back end runs it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sinew/backend/interpreter.h"
#include "sinew/backend/jit.h"
#include "sinew/program/interface.h"
#include "sinew/program/program.h"

namespace sinew::cli {

enum class How : std::uint8_t { kCompiled, kInterpreted };

class Evaluator {
 public:
  // kCompiled: machine code made in this process; where LLVM is missing, the system's C compiler.
  // Throws Error.
  Evaluator(const program::Program& program, How how, backend::JitLevel level);

  const program::Interface& interface() const { return interface_; }
  // One evaluation: interface().in_size numbers in, out_size out; states carry over to the next.
  void evaluate(const double* in, double* out);

 private:
  program::Interface interface_;
  std::optional<backend::Interpreter> interpreter_;
  std::optional<backend::JitFunction> function_;
  std::vector<double> in_and_state_, out_and_state_;
};

// The names of single numbers, as they head CSV columns: a variable of one number has its own name,
// one of more has NAME[0], NAME[1], …
std::vector<std::string> column_names(const program::Program& program,
                                      const std::vector<program::Slot>& slots);

}  // namespace sinew::cli
