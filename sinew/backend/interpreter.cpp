#include "sinew/backend/interpreter.h"

#include <algorithm>

#include "sinew/program/finite.h"
#include "sinew/program/kernels.h"
#include "sinew/program/trace.h"
#include "sinew/program/validate.h"

namespace sinew::backend {

Interpreter::Interpreter(const program::Program& program) {
  program::require_valid(program);
  program::require_finite(program);
  interface_ = program::interface_of(program);

  std::vector<std::size_t> place(program.variables.size());
  std::size_t total = 0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    place[i] = total;
    total += program.variables[i].size;
  }
  numbers_.resize(total, 0.0);
  for (std::size_t i = 0; i < place.size(); ++i) {
    const std::vector<double>& value = program.variables[i].value;
    std::copy(value.begin(), value.end(), numbers_.begin() + static_cast<std::ptrdiff_t>(place[i]));
  }

  for (const std::uint32_t index : program.schedule) {
    const program::Closure& closure = program.closures[index];
    const program::Kernel& kernel = *program::find_kernel(closure.operation);
    steps_.push_back(
        {kernel.evaluate, kernel.evaluate_many, arguments_.size(), closure.arguments.size()});
    for (const std::uint32_t variable : closure.arguments) {
      arguments_.push_back(numbers_.data() + place[variable]);
      sizes_.push_back(program.variables[variable].size);
    }
  }

  const auto copies = [&](const std::vector<program::Slot>& slots) {
    std::vector<Copy> result;
    for (const program::Slot& slot : slots) {
      result.push_back({slot.offset, place[slot.variable], program.variables[slot.variable].size});
    }
    return result;
  };
  inputs_ = copies(interface_.inputs);
  outputs_ = copies(interface_.outputs);
  states_ = copies(interface_.states);
  for (const program::Slot& slot : interface_.states) {
    const std::vector<double>& value = program.variables[slot.variable].value;
    first_states_.insert(first_states_.end(), value.begin(), value.end());
  }
  if (program.derivatives.empty()) return;
  graph_.emplace(program::trace(program));
  graph_in_.resize(interface_.in_size + interface_.state_size);
  graph_out_.resize(interface_.out_size + interface_.state_size);
  reset();
}

// States lie behind the inputs, and their next values behind the outputs.
void Interpreter::evaluate_graph(const double* in, double* out) {
  std::copy_n(in, interface_.in_size, graph_in_.begin());
  graph_->evaluate(graph_in_.data(), graph_out_.data());
  std::copy_n(graph_out_.begin(), interface_.out_size, out);
  std::copy_n(graph_out_.begin() + interface_.out_size, interface_.state_size,
              graph_in_.begin() + interface_.in_size);
}

void Interpreter::evaluate(const double* in, double* out) {
  if (graph_) {
    evaluate_graph(in, out);
    return;
  }
  for (const Copy& c : inputs_) std::copy_n(in + c.offset, c.size, numbers_.data() + c.place);
  for (const Step& step : steps_) {
    double* const* arguments = arguments_.data() + step.first_argument;
    if (step.evaluate != nullptr)
      step.evaluate(arguments);
    else
      step.evaluate_many(arguments, {sizes_.data() + step.first_argument, step.arguments});
  }
  for (const Copy& c : outputs_) std::copy_n(numbers_.data() + c.place, c.size, out + c.offset);
}

void Interpreter::reset() {
  if (graph_)
    std::copy(first_states_.begin(), first_states_.end(), graph_in_.begin() + interface_.in_size);
  for (const Copy& c : states_) {
    std::copy_n(first_states_.data() + c.offset, c.size, numbers_.data() + c.place);
  }
}

}  // namespace sinew::backend
