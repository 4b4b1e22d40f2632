// Evaluates a scalar data-flow graph number by number: what the interpreter does for programs whose
// results no closure writes (derivatives).
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/program/dag/dag.h"

namespace sinew::backend {

class GraphInterpreter {
 public:
  // All memory is taken here.
  explicit GraphInterpreter(const program::Computation& computation);

  // `in`: computation.inputs numbers, `out`: one for each result. Real-time safe: bounded, without
  // allocation or locks.
  void evaluate(const double* in, double* out);

 private:
  struct Operand {
    std::uint32_t place = 0;
    bool negative = false;
  };
  struct Operation {
    program::Op op;
    std::uint32_t place;
    Operand a, b, c;
  };
  double value(const Operand& operand) const {
    return operand.negative ? -values_[operand.place] : values_[operand.place];
  }

  std::vector<double> values_;
  std::vector<Operation> operations_;  // operands first
  struct Input {
    std::uint32_t index, place;
  };
  std::vector<Input> inputs_;
  std::vector<Operand> results_;
};

}  // namespace sinew::backend
