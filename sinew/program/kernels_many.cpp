#include "sinew/program/kernels_many.h"

#include <array>

#include "sinew/math/layout.h"

namespace sinew::program {
namespace {

// One argument after the other.
template <typename S>
void one_after_the_other(S* const* arguments, std::span<const std::uint32_t> sizes) {
  S* out = arguments[sizes.size() - 1];
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i)
    for (std::uint32_t k = 0; k < sizes[i]; ++k) *out++ = arguments[i][k];
}

// Arguments are columns of so many numbers, or several of them, of a matrix that is written row by
// row.
template <typename S, std::uint32_t kRows>
void as_columns(S* const* arguments, std::span<const std::uint32_t> sizes) {
  S* const out = arguments[sizes.size() - 1];
  const std::uint32_t columns = sizes.back() / kRows;
  std::uint32_t column = 0;
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i)
    for (std::uint32_t k = 0; k < sizes[i]; k += kRows, ++column)
      for (std::uint32_t row = 0; row < kRows; ++row)
        out[row * columns + column] = arguments[i][k + row];
}

// The joints of a floating robot, from the number of its mass matrix' parts: an inertia, n
// wrenches, n x n entries.
std::uint32_t joints_of_floating(std::size_t parts) {
  std::uint32_t n = 0;
  while (1 + n + n * n < parts) ++n;
  return n;
}

std::uint32_t size_of_floating_mass_matrix(std::span<const std::uint32_t> sizes) {
  const std::uint32_t rows = 6 + joints_of_floating(sizes.size());
  return rows * rows;
}

// [I [h]x; -[h]x m], then the joints' wrenches as rows and columns, then their entries.
template <typename S>
void floating_mass_matrix(S* const* arguments, std::span<const std::uint32_t> sizes) {
  const std::uint32_t n = joints_of_floating(sizes.size() - 1), rows = 6 + n;
  const auto I = math::Layout<math::RigidBodyInertia<S>>::load(arguments[0]);
  const math::Symmetric3<S>& J = I.rotational;
  const math::Vector3<S>& h = I.first_moment;
  const S zero(0);
  const S base[6][6] = {
      {J.xx, J.xy, J.xz, zero, -h.z, h.y},   {J.xy, J.yy, J.yz, h.z, zero, -h.x},
      {J.xz, J.yz, J.zz, -h.y, h.x, zero},   {zero, h.z, -h.y, I.mass, zero, zero},
      {-h.z, zero, h.x, zero, I.mass, zero}, {h.y, -h.x, zero, zero, zero, I.mass}};
  S* const M = arguments[sizes.size() - 1];
  for (std::uint32_t r = 0; r < 6; ++r)
    for (std::uint32_t c = 0; c < 6; ++c) M[r * rows + c] = base[r][c];
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t r = 0; r < 6; ++r)
      M[r * rows + 6 + j] = M[(6 + j) * rows + r] = arguments[1 + j][r];
    for (std::uint32_t c = 0; c < n; ++c) M[(6 + j) * rows + 6 + c] = *arguments[1 + n + j * n + c];
  }
}

// The size of an output is the sum of its arguments' sizes.
constexpr std::array kNumbers = {Port{1, false}, Port{0, true}};
constexpr std::array kColumns = {Port{6, false}, Port{0, true}};
constexpr std::array kAny = {Port{0, false}, Port{0, true}};

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
  std::vector<Kernel> rows = {
      row("mass-matrix-from-entries", kNumbers, &one_after_the_other<double>,
          &one_after_the_other<Traced>),
      row("jacobian-from-columns", kColumns, &as_columns<double, 6>, &as_columns<Traced, 6>),
      row("floating-jacobian-from-columns", kAny, &as_columns<double, 6>, &as_columns<Traced, 6>),
      row("momentum-matrix-from-columns", kColumns, &as_columns<double, 6>, &as_columns<Traced, 6>),
      row("floating-momentum-matrix-from-columns", kAny, &as_columns<double, 6>,
          &as_columns<Traced, 6>),
      row("analytic-jacobian-from-columns", kAny, &as_columns<double, 7>, &as_columns<Traced, 7>),
      row("floating-analytic-jacobian-from-columns", kAny, &as_columns<double, 7>,
          &as_columns<Traced, 7>),
      row("linear-jacobian-from-columns", kAny, &as_columns<double, 3>, &as_columns<Traced, 3>),
      row("floating-linear-jacobian-from-columns", kAny, &as_columns<double, 3>,
          &as_columns<Traced, 3>),
      row("floating-mass-matrix-from-parts", kAny, &floating_mass_matrix<double>,
          &floating_mass_matrix<Traced>)};
  rows.back().size_of_many = &size_of_floating_mass_matrix;
  return rows;
}

}  // namespace sinew::program
