#include "evaluator.h"

#include <algorithm>

#include "sinew/program/scalar_program.h"

namespace sinew::cli {

Evaluator::Evaluator(const program::Program& program, How how, backend::JitLevel level)
    : interface_(program::interface_of(program)) {
  if (how == How::kInterpreted) {
    interpreter_.emplace(program);
    return;
  }
  function_ = backend::jit_compile(program::scalar_program(program), {level, "", false});
  in_and_state_.resize(interface_.in_size + interface_.state_size);
  out_and_state_.resize(interface_.out_size + interface_.state_size);
  for (const program::Slot& slot : interface_.states) {
    const std::vector<double>& first = program.variables[slot.variable].value;
    std::copy(first.begin(), first.end(), in_and_state_.begin() + interface_.in_size + slot.offset);
  }
}

void Evaluator::evaluate(const double* in, double* out) {
  if (interpreter_) {
    interpreter_->evaluate(in, out);
    return;
  }
  std::copy_n(in, interface_.in_size, in_and_state_.begin());
  (*function_)(in_and_state_.data(), out_and_state_.data());
  std::copy_n(out_and_state_.begin(), interface_.out_size, out);
  std::copy_n(out_and_state_.begin() + interface_.out_size, interface_.state_size,
              in_and_state_.begin() + interface_.in_size);
}

std::vector<std::string> column_names(const program::Program& program,
                                      const std::vector<program::Slot>& slots) {
  std::vector<std::string> names;
  for (const program::Slot& slot : slots) {
    const program::Variable& variable = program.variables[slot.variable];
    if (variable.size == 1) {
      names.push_back(variable.name);
      continue;
    }
    for (std::uint32_t i = 0; i < variable.size; ++i) {
      names.push_back(variable.name + "[" + std::to_string(i) + "]");
    }
  }
  return names;
}

}  // namespace sinew::cli
