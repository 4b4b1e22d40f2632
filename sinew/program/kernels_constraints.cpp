#include "sinew/program/kernels_constraints.h"

#include <algorithm>
#include <array>

#include "sinew/math/constraint_solve.h"
#include "sinew/math/hybrid_dynamics.h"

namespace sinew::program {
namespace {

using Sizes = std::span<const std::uint32_t>;

// The first half of the arguments times the second half; as long as one of the first.
template <typename S>
void sum_of_products(S* const* arguments, Sizes sizes) {
  const std::size_t pairs = (sizes.size() - 1) / 2;
  S* const out = arguments[sizes.size() - 1];
  for (std::uint32_t k = 0; k < sizes.back(); ++k) {
    out[k] = S(0);
    for (std::size_t i = 0; i < pairs; ++i)
      out[k] = out[k] + arguments[i][k] * *arguments[pairs + i];
  }
}

std::uint32_t size_of_first(Sizes sizes) { return sizes.front(); }
std::uint32_t one_number(Sizes) { return 1; }

// n (n + 1) / 2 entries, n residuals and one tolerance.
std::size_t arguments_of(int constraints) {
  const auto n = static_cast<std::size_t>(constraints);
  return n * (n + 1) / 2 + n + 1;
}

// Not more than the tables hold.
int constraints_of(std::size_t arguments) {
  int n = 1;
  while (n < math::kMostConstraints && arguments_of(n) < arguments) ++n;
  return n;
}

std::uint32_t size_of_magnitudes(Sizes sizes) {
  const int n = constraints_of(sizes.size());
  const bool fits = arguments_of(n) == sizes.size();
  return fits ? static_cast<std::uint32_t>(n) : 0;  // a size that no data block has
}

std::uint32_t size_of_truncated(Sizes sizes) {
  const std::uint32_t n = size_of_magnitudes(sizes);
  return n <= math::kMostTruncatedConstraints ? n : 0;
}

template <typename S>
using Solve = void (*)(math::ConstraintSystem<S>&, const S&, S*);

template <typename S, Solve<S> kSolve>
void magnitudes(S* const* arguments, Sizes sizes) {
  math::ConstraintSystem<S> system;
  system.count = static_cast<int>(sizes.back());
  S* const* next = arguments;
  for (int i = 0; i < system.count; ++i)
    for (int j = 0; j <= i; ++j) system.L[i][j] = **next++;
  for (int i = 0; i < system.count; ++i) system.r[i] = **next++;
  kSolve(system, **next, arguments[sizes.size() - 1]);
}

// A vector, and one factor for each of its numbers.
template <typename S>
void select_magnitude(S* const* arguments, Sizes sizes) {
  S sum(0);
  for (std::size_t i = 0; i + 2 < sizes.size(); ++i)
    sum = sum + *arguments[1 + i] * arguments[0][i];
  *arguments[sizes.size() - 1] = sum;
}

template <typename S>
void scale(S* const* arguments, Sizes sizes) {
  const int n = static_cast<int>((sizes.size() - 1) / 3);
  *arguments[sizes.size() - 1] = math::scale_within_limits<S>(
      n, [&](int j) { return *arguments[j]; }, [&](int j) { return *arguments[n + j]; },
      [&](int j) { return *arguments[2 * n + j]; });
}

constexpr std::array kNumbers = {Port{1, false}, Port{0, true}};
constexpr std::array kAny = {Port{0, false}, Port{0, true}};

}  // namespace

std::vector<Kernel> constraint_kernels() {
  const auto row = [](std::string_view operation, std::span<const Port> ports, auto evaluate,
                      auto trace, auto size) {
    Kernel kernel;
    kernel.operation = operation;
    kernel.ports = ports;
    kernel.evaluate_many = evaluate;
    kernel.trace_many = trace;
    kernel.size_of_many = size;
    return kernel;
  };
  using D = double;
  using T = Traced;
  return {
      row("acceleration-energy-of-joint-forces", kNumbers, &sum_of_products<D>, &sum_of_products<T>,
          &one_number),
      row("weigh-magnitudes", kNumbers, &sum_of_products<D>, &sum_of_products<T>, &one_number),
      row("weigh-joint-forces", kNumbers, &sum_of_products<D>, &sum_of_products<T>, &one_number),
      row("weigh-floating-forces", kAny, &sum_of_products<D>, &sum_of_products<T>, &size_of_first),
      row("constraint-magnitudes-in-order", kNumbers, &magnitudes<D, &math::solve_in_order<D>>,
          &magnitudes<T, &math::solve_in_order<T>>, &size_of_magnitudes),
      row("constraint-magnitudes-damped", kNumbers, &magnitudes<D, &math::solve_damped<D>>,
          &magnitudes<T, &math::solve_damped<T>>, &size_of_magnitudes),
      row("constraint-magnitudes-truncated", kNumbers, &magnitudes<D, &math::solve_truncated<D>>,
          &magnitudes<T, &math::solve_truncated<T>>, &size_of_truncated),
      row("constraint-magnitude", kAny, &select_magnitude<D>, &select_magnitude<T>, &one_number),
      row("scale-within-limits", kNumbers, &scale<D>, &scale<T>, &one_number)};
}

}  // namespace sinew::program
