#include "sinew/program/kernels_joints.h"

#include <algorithm>
#include <array>

#include "sinew/math/compound_joint.h"
#include "sinew/program/kernel_row.h"

namespace sinew::program {
namespace {

using namespace sinew::math;
using Sizes = std::span<const std::uint32_t>;

// Arguments that are there in any case: the map and the output.
constexpr std::size_t kMapAndOutput = 2;

// All numbers of the arguments before the map, each times its factor, and what is added. The map
// starts with their count.
template <typename S>
void weighted_sum(S* const* arguments, Sizes sizes) {
  const std::size_t last = sizes.size() - kMapAndOutput;
  const S* factor = arguments[last] + 1;
  S sum(0);
  for (std::size_t i = 0; i < last; ++i)
    for (std::uint32_t k = 0; k < sizes[i]; ++k) sum = sum + *factor++ * arguments[i][k];
  *arguments[last + 1] = sum + *factor;
}

// One argument after the other, without the map where there is one, as long as the output is.
template <typename S>
void join(S* const* arguments, Sizes sizes) {
  S* out = arguments[sizes.size() - 1];
  std::uint32_t left = sizes.back();
  for (std::size_t i = 0; left > 0; ++i)
    for (std::uint32_t k = 0; k < sizes[i] && left > 0; ++k, --left) *out++ = arguments[i][k];
}

template <typename S, void (*kFactorise)(S*, int)>
void factorise(S* const* arguments, Sizes sizes) {
  S* const out = arguments[2];
  std::copy_n(arguments[0], sizes[0], out);
  int n = 0;
  while (static_cast<std::uint32_t>(n * n) < sizes[0]) ++n;
  kFactorise(out, n);
}

template <typename S>
void accelerate(S* const* arguments, Sizes sizes) {
  const std::uint32_t n = sizes[1];
  S* const x = arguments[4];
  for (std::uint32_t i = 0; i < n; ++i) x[i] = arguments[1][i] - arguments[2][i];
  solve_decomposed(arguments[0], static_cast<int>(n), x);
}

template <typename S, void (*kSolve)(const S*, int, S*)>
void solve_half(S* const* arguments, Sizes sizes) {
  std::copy_n(arguments[1], sizes[1], arguments[3]);
  kSolve(arguments[0], static_cast<int>(sizes[1]), arguments[3]);
}

template <typename S>
void energy_of_drives(S* const* arguments, Sizes sizes) {
  *arguments[4] =
      energy_decomposed(arguments[0], static_cast<int>(sizes[1]), arguments[1], arguments[2]);
}

// Pairs of a drive and how many times it counts: first all drives, then all numbers, then the map.
template <typename S>
void weigh_drives(S* const* arguments, Sizes sizes) {
  const std::size_t pairs = (sizes.size() - kMapAndOutput) / 2;
  S* const sum = arguments[sizes.size() - 1];
  for (std::uint32_t k = 0; k < sizes.back(); ++k) {
    sum[k] = S(0);
    for (std::size_t i = 0; i < pairs; ++i)
      sum[k] = sum[k] + *arguments[pairs + i] * arguments[i][k];
  }
}

template <typename S>
void couple_mass(S* const* arguments, Sizes sizes) {
  int n = 0;
  while (static_cast<std::uint32_t>(n * n) < sizes[0]) ++n;
  int m = 0;
  while (static_cast<std::uint32_t>(m * m) < sizes[2]) ++m;
  const S* const map = arguments[1];
  couple_mass_matrix(arguments[0], map + 2, map + 2 + n * m, n, m, arguments[2]);
}

template <typename S, int kRows>
void couple(S* const* arguments, Sizes sizes) {
  const int n = static_cast<int>(sizes[0]) / kRows, m = static_cast<int>(sizes[2]) / kRows;
  couple_columns(arguments[0], arguments[1] + 2, kRows, n, m, arguments[2]);
}

// Sizes of outputs from those of the arguments; 0, which no data block has, where they do not fit.
std::uint32_t root(std::uint32_t square) {
  std::uint32_t n = 0;
  while (n * n < square) ++n;
  return n * n == square ? n : 0;
}

std::uint32_t one(Sizes sizes) {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i) count += sizes[i];
  return sizes.size() > 1 && sizes.back() == count + 2 ? 1 : 0;
}

template <std::uint32_t kCount>
std::uint32_t fixed(Sizes sizes) {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i) count += sizes[i];
  return count >= kCount ? kCount : 0;
}

std::uint32_t of_factor(Sizes sizes) { return sizes.size() == 2 && root(sizes[0]) ? sizes[0] : 0; }

std::uint32_t of_acceleration(Sizes sizes) {
  const bool fit = sizes.size() == 4 && sizes[1] == sizes[2] && sizes[0] == sizes[1] * sizes[1];
  return fit ? sizes[1] : 0;
}

std::uint32_t of_half(Sizes sizes) {
  return sizes.size() == 3 && sizes[0] == sizes[1] * sizes[1] ? sizes[1] : 0;
}

std::uint32_t of_weighed(Sizes sizes) { return sizes.size() % 2 == 1 ? sizes.front() : 0; }

std::uint32_t of_energy(Sizes sizes) { return of_acceleration(sizes) != 0 ? 1 : 0; }

std::uint32_t of_coupled_mass(Sizes sizes) {
  const std::uint32_t n = sizes.size() == 2 ? root(sizes[0]) : 0;
  if (n == 0 || sizes[1] < 2 + n || (sizes[1] - 2 - n) % n != 0) return 0;
  const std::uint32_t m = (sizes[1] - 2 - n) / n;
  return m * m;
}

template <std::uint32_t kRows>
std::uint32_t of_coupled(Sizes sizes) {
  const std::uint32_t n = sizes.size() == 2 && sizes[0] % kRows == 0 ? sizes[0] / kRows : 0;
  if (n == 0 || sizes[1] < 2 || (sizes[1] - 2) % n != 0) return 0;
  return kRows * ((sizes[1] - 2) / n);
}

constexpr std::array kAny = {Port{0, false}, Port{0, true}};

}  // namespace

std::vector<Kernel> kernels_of_joints() {
  std::vector<Kernel> rows = {
      row("position-to-pose-spherical",
          []<typename S>(const SphericalPosition<S>& q) { return first_part_pose(q); }),
      row("position-to-pose-free",
          []<typename S>(const FloatingPosition<S>& q) { return first_part_pose(q); }),
      row("velocity-to-twist-spherical",
          []<typename S>(const Vector3<S>& w) {
            return VelocityTwist<S>{w, {S(0), S(0), S(0)}};
          }),
      row("acceleration-to-twist-spherical",
          []<typename S>(const Vector3<S>& al) {
            return AccelerationTwist<S>{al, {S(0), S(0), S(0)}};
          }),
      row("force-with-rotor",
          []<typename S>(const S& tau, const S& qdd, const S& I) { return S(tau + I * qdd); }),
      row("unit-force-with-rotor", []<typename S>(const S& D, const S& I) { return S(D + I); }),
  };
  const auto many = [&](std::string_view operation, auto evaluate, auto trace, auto size) {
    Kernel kernel;
    kernel.operation = operation;
    kernel.ports = kAny;
    kernel.evaluate_many = evaluate;
    kernel.trace_many = trace;
    kernel.size_of_many = size;
    rows.push_back(kernel);
  };
  for (const std::string_view operation :
       {"position-of-part", "velocity-of-part", "acceleration-of-part", "force-of-part",
        "position-from-leader", "velocity-from-leader", "acceleration-from-leader",
        "force-of-coupled"})
    many(operation, &weighted_sum<double>, &weighted_sum<Traced>, &one);
  for (const std::string_view operation :
       {"join-joint-forces", "join-joint-accelerations", "join-floating-forces"})
    many(operation, &join<double>, &join<Traced>, nullptr);
  many("spherical-acceleration-of-parts", &join<double>, &join<Traced>, &fixed<3>);
  many("floating-acceleration-of-parts", &join<double>, &join<Traced>, &fixed<6>);
  many("floating-acceleration-of-robot", &join<double>, &join<Traced>, &fixed<6>);
  many("couple-mass-matrix", &couple_mass<double>, &couple_mass<Traced>, &of_coupled_mass);
  many("couple-jacobian", &couple<double, 6>, &couple<Traced, 6>, &of_coupled<6>);
  many("couple-analytic-jacobian", &couple<double, 7>, &couple<Traced, 7>, &of_coupled<7>);
  many("couple-linear-jacobian", &couple<double, 3>, &couple<Traced, 3>, &of_coupled<3>);
  many("couple-momentum-matrix", &couple<double, 6>, &couple<Traced, 6>, &of_coupled<6>);
  many("factorise-mass-matrix", &factorise<double, &factorise_mass_matrix<double>>,
       &factorise<Traced, &factorise_mass_matrix<Traced>>, &of_factor);
  many("decompose-mass-matrix", &factorise<double, &decompose_mass_matrix<double>>,
       &factorise<Traced, &decompose_mass_matrix<Traced>>, &of_factor);
  many("acceleration-from-decomposition", &accelerate<double>, &accelerate<Traced>,
       &of_acceleration);
  many("drive-from-decomposition", &solve_half<double, &drive_decomposed<double>>,
       &solve_half<Traced, &drive_decomposed<Traced>>, &of_half);
  many("acceleration-from-drive", &solve_half<double, &accelerate_decomposed<double>>,
       &solve_half<Traced, &accelerate_decomposed<Traced>>, &of_half);
  many("acceleration-energy-of-drives", &energy_of_drives<double>, &energy_of_drives<Traced>,
       &of_energy);
  many("weigh-drives", &weigh_drives<double>, &weigh_drives<Traced>, &of_weighed);
  return rows;
}

}  // namespace sinew::program
