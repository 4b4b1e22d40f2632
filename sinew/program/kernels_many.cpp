#include "sinew/program/kernels_many.h"

#include <array>

namespace sinew::program {
namespace {

// One argument after the other.
template <typename S>
void one_after_the_other(S* const* arguments, std::span<const std::uint32_t> sizes) {
  S* out = arguments[sizes.size() - 1];
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i)
    for (std::uint32_t k = 0; k < sizes[i]; ++k) *out++ = arguments[i][k];
}

// Arguments are the columns of a matrix that is written row by row.
template <typename S>
void as_columns(S* const* arguments, std::span<const std::uint32_t> sizes) {
  S* const out = arguments[sizes.size() - 1];
  const std::size_t columns = sizes.size() - 1;
  for (std::size_t column = 0; column < columns; ++column)
    for (std::uint32_t row = 0; row < sizes[column]; ++row)
      out[row * columns + column] = arguments[column][row];
}

// The size of an output is the sum of its arguments' sizes.
constexpr std::array kNumbers = {Port{1, false}, Port{0, true}};
constexpr std::array kColumns = {Port{6, false}, Port{0, true}};

}  // namespace

std::vector<Kernel> kernels_of_many() {
  const auto row = [](std::string_view operation, std::span<const Port> ports, auto evaluate,
                      auto trace) {
    Kernel kernel;
    kernel.operation = operation;
    kernel.ports = ports;
    kernel.evaluate_many = evaluate;
    kernel.trace_many = trace;
    return kernel;
  };
  return {row("mass-matrix-from-entries", kNumbers, &one_after_the_other<double>,
              &one_after_the_other<Traced>),
          row("jacobian-from-columns", kColumns, &as_columns<double>, &as_columns<Traced>)};
}

}  // namespace sinew::program
