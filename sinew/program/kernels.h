// The numeric functions behind the operators of algorithm models: one row an operator.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "sinew/program/dag/traced.h"

namespace sinew::program {

// One argument of an operator: how many numbers, and whether the operator writes them.
struct Port {
  std::uint32_t size = 0;
  bool output = false;
};

struct Kernel {
  std::string_view operation = {};   // name in the operator catalogue: "compose-pose"
  std::span<const Port> ports = {};  // in the catalogue's order, outputs last
  // The operator on numbers; arguments[i] points to ports[i].size numbers.
  void (*evaluate)(double* const* arguments) = nullptr;
  // The same operator, recorded.
  void (*trace)(Traced* const* arguments) = nullptr;
  // Instead of these, for an operator whose first port takes any number of arguments: `sizes` has
  // one entry for each argument, the output's last.
  void (*evaluate_many)(double* const* arguments, std::span<const std::uint32_t> sizes) = nullptr;
  void (*trace_many)(Traced* const* arguments, std::span<const std::uint32_t> sizes) = nullptr;

  // Of an operator of many arguments: the output's size; without it, the sum of the arguments'.
  std::uint32_t (*size_of_many)(std::span<const std::uint32_t> sizes) = nullptr;

  bool many() const { return evaluate_many != nullptr; }
  // The port of an argument, of a closure with `count` arguments.
  const Port& port(std::size_t argument, std::size_t count) const {
    return many() ? ports[argument + 1 == count ? 1 : 0] : ports[argument];
  }
};

// Every row, sorted by operation.
std::span<const Kernel> kernels();

// The operator's row, or nullptr.
const Kernel* find_kernel(std::string_view operation);

// Its function in the C support library (math/sinew_math.h): "sinew_compose_pose".
std::string support_function(std::string_view operation);

}  // namespace sinew::program
