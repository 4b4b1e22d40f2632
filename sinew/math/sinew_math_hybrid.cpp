// The part of the C support library for hybrid dynamics.
#include "sinew/math/constraint_solve.h"
#include "sinew/math/hybrid_dynamics.h"
#include "sinew/math/layout.h"
#include "sinew/math/sinew_math.h"

namespace {

using namespace sinew::math;

Wrench<double> wrench(const double* at) { return Layout<Wrench<double>>::load(at); }
AccelerationTwist<double> twist(const double* at) {
  return Layout<AccelerationTwist<double>>::load(at);
}
void store(const Wrench<double>& value, double* at) { Layout<Wrench<double>>::store(value, at); }

// First half times second half, for `size` numbers each.
void sum_of_products(const double* const parts[], int count, int size, double* sum) {
  const int pairs = count / 2;
  for (int k = 0; k < size; ++k) {
    sum[k] = 0;
    for (int i = 0; i < pairs; ++i) sum[k] += parts[i][k] * *parts[pairs + i];
  }
}

template <typename Solve>
void magnitudes(const double* const parts[], int count, double* x, Solve solve) {
  ConstraintSystem<double> system;
  while (system.count * (system.count + 3) / 2 + 1 < count) ++system.count;
  for (int i = 0; i < system.count; ++i)
    for (int j = 0; j <= i; ++j) system.L[i][j] = **parts++;
  for (int i = 0; i < system.count; ++i) system.r[i] = **parts++;
  solve(system, **parts, x);
}

}  // namespace

void sinew_subtract_wrench(const double* a, const double* b, double* c) {
  store(subtract(wrench(a), wrench(b)), c);
}

void sinew_add_joint_force(const double* a, const double* b, double* c) { *c = *a + *b; }

void sinew_add_floating_force(const double* a, const double* b, double* c) {
  store(add(wrench(a), wrench(b)), c);
}

void sinew_joint_acceleration_from_drive(const double* e, const double* D, double* qdd) {
  *qdd = *e / *D;
}

void sinew_release_wrench(const double* F, const double* U, const double* qdd, double* F_a) {
  store(release(wrench(F), wrench(U), *qdd), F_a);
}

void sinew_acceleration_energy_of_wrench(const double* F, const double* A, double* E) {
  *E = acceleration_energy(wrench(F), twist(A));
}

void sinew_acceleration_energy_of_floating_force(const double* e, const double* qdd, double* E) {
  *E = acceleration_energy(wrench(e), twist(qdd));
}

void sinew_acceleration_energy_of_joint_forces(const double* const parts[], int count, double* E) {
  sum_of_products(parts, count, 1, E);
}

void sinew_add_acceleration_energy(const double* a, const double* b, double* c) { *c = *a + *b; }

void sinew_subtract_acceleration_energy(const double* a, const double* b, double* c) {
  *c = *a - *b;
}

void sinew_constraint_magnitudes_in_order(const double* const parts[], int count, double* x) {
  magnitudes(parts, count, x, solve_in_order<double>);
}

void sinew_constraint_magnitudes_damped(const double* const parts[], int count, double* x) {
  magnitudes(parts, count, x, solve_damped<double>);
}

void sinew_constraint_magnitudes_truncated(const double* const parts[], int count, double* x) {
  magnitudes(parts, count, x, solve_truncated<double>);
}

void sinew_constraint_magnitude(const double* const parts[], int count, double* x) {
  *x = 0;
  for (int i = 0; i + 1 < count; ++i) *x += *parts[1 + i] * parts[0][i];
}

void sinew_weigh_magnitudes(const double* const parts[], int count, double* sum) {
  sum_of_products(parts, count, 1, sum);
}

void sinew_weigh_joint_forces(const double* const parts[], int count, double* sum) {
  sum_of_products(parts, count, 1, sum);
}

void sinew_weigh_floating_forces(const double* const parts[], int count, double* sum) {
  sum_of_products(parts, count, 6, sum);
}

void sinew_scale_within_limits(const double* const parts[], int count, double* s) {
  const int n = count / 3;
  *s = scale_within_limits<double>(
      n, [&](int j) { return *parts[j]; }, [&](int j) { return *parts[n + j]; },
      [&](int j) { return *parts[2 * n + j]; });
}
