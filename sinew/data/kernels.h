// Formulas that were compiled ahead of time, for the runtime engine: what the interpreter would do
// number by number is then one call. A kernel is found by its formula's fingerprint, so that it can
// never stand for a formula that says something else.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "sinew/data/formula.h"

namespace sinew::data {

// Reads input i of the formula at inputs + from[i] and writes output i to outputs + to[i], all
// bytes: the numbers may lie in a value's memory or among the engine's registers. Everything is
// read before anything is written.
using Kernel = void (*)(const char* inputs, const std::uint32_t* from, char* outputs,
                        const std::uint32_t* to);

struct KernelEntry {
  std::uint64_t fingerprint = 0;
  Kernel function = nullptr;
};

// Of the arithmetic itself; names do not matter.
std::uint64_t fingerprint(const Formula& formula);
// The body of a kernel as C++ source; read(address) and write(address, number) are the caller's.
std::string kernel_source(const Formula& formula);

}  // namespace sinew::data
