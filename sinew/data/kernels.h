// Formulas that were compiled ahead of time, for the runtime engine: what the interpreter would do
// number by number is then one call. A kernel is found by its formula's fingerprint, so that it can
// never stand for a formula that says something else.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "sinew/data/formula.h"

namespace sinew::data {

// Reads the formula's inputs and writes its outputs, each one after the other.
using Kernel = void (*)(const double* inputs, double* outputs);

struct KernelEntry {
  std::uint64_t fingerprint = 0;
  Kernel function = nullptr;
};

// Of the arithmetic itself; names do not matter.
std::uint64_t fingerprint(const Formula& formula);
// The body of a kernel as C++ source: statements on `in` and `out`.
std::string kernel_source(const Formula& formula);

}  // namespace sinew::data
