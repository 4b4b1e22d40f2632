// Evaluates a program closure by closure with the operators' functions for double. It needs no
// compiler, starts at once, and is the reference for every other back end. A program with
// derivatives, which no closure computes, is evaluated number by number instead.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sinew/backend/graph_interpreter.h"
#include "sinew/program/interface.h"
#include "sinew/program/program.h"

namespace sinew::backend {

class Interpreter {
 public:
  // Throws Error if the program is not valid or divides by a constant zero. All memory is taken
  // here.
  explicit Interpreter(const program::Program& program);

  std::size_t in_size() const { return interface_.in_size; }
  std::size_t out_size() const { return interface_.out_size; }
  std::size_t state_size() const { return interface_.state_size; }
  const program::Interface& interface() const { return interface_; }

  // One evaluation: reads in_size() numbers, writes out_size(). States carry over to the next one.
  // Real-time safe: bounded, without allocation or locks.
  void evaluate(const double* in, double* out);

  // Sets the states to their first values.
  void reset();

 private:
  struct Step {
    void (*evaluate)(double* const* arguments);
    void (*evaluate_many)(double* const* arguments, std::span<const std::uint32_t> sizes);
    std::size_t first_argument;  // into arguments_ and sizes_
    std::size_t arguments;
  };
  struct Copy {
    std::size_t offset;  // in the caller's array
    std::size_t place;   // in numbers_
    std::size_t size;
  };

  void evaluate_graph(const double* in, double* out);

  program::Interface interface_;
  std::optional<GraphInterpreter> graph_;  // of a program with derivatives
  std::vector<double> graph_in_, graph_out_;
  std::vector<double> numbers_;  // every variable, one after the other
  std::vector<double*> arguments_;
  std::vector<std::uint32_t> sizes_;
  std::vector<Step> steps_;
  std::vector<Copy> inputs_, outputs_;
  std::vector<double> first_states_;
  std::vector<Copy> states_;  // offset: into first_states_
};

}  // namespace sinew::backend
