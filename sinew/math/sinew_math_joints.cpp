#include "sinew/math/sinew_math_joints.h"

#include "sinew/math/c_arrays.h"
#include "sinew/math/compound_joint.h"

namespace {

using namespace sinew::math;
using namespace sinew::math::c_arrays;

// Numbers may come in one array or in one each.
void weighted_sum(const double* const in[], int count, double* out) {
  const double* const map = in[count - 1];
  const int numbers = static_cast<int>(map[0]);
  double sum = 0;
  for (int k = 0; k < numbers; ++k) {
    const double number = count == 2 ? in[0][k] : *in[k];
    sum += map[1 + k] * number;
  }
  *out = sum + map[1 + numbers];
}

void singles(const double* const in[], int count, double* out) {
  for (int i = 0; i < count; ++i) out[i] = *in[i];
}

void couple(const double* const in[], int rows, double* out) {
  const double* const map = in[1];
  couple_columns(in[0], map + 2, rows, static_cast<int>(map[0]), static_cast<int>(map[1]), out);
}

int copy_matrix(const double* const in[], double* out) {
  const int n = static_cast<int>(*in[1]);
  for (int i = 0; i < n * n; ++i) out[i] = in[0][i];
  return n;
}

}  // namespace

void sinew_position_to_pose_spherical(const double* q, double* X) {
  store(first_part_pose(Layout<SphericalPosition<double>>::load(q)), X);
}

void sinew_position_to_pose_free(const double* q, double* X) {
  store(first_part_pose(Layout<FloatingPosition<double>>::load(q)), X);
}

void sinew_velocity_to_twist_spherical(const double* qd, double* V) {
  for (int i = 0; i < 3; ++i) V[i] = qd[i], V[3 + i] = 0;
}

void sinew_acceleration_to_twist_spherical(const double* qdd, double* A) {
  sinew_velocity_to_twist_spherical(qdd, A);
}

void sinew_spherical_acceleration_of_parts(const double* const in[], int, double* qdd) {
  singles(in, 3, qdd);
}

void sinew_floating_acceleration_of_parts(const double* const in[], int, double* qdd) {
  singles(in, 6, qdd);
}

void sinew_floating_acceleration_of_robot(const double* const in[], int, double* qdd) {
  for (int i = 0; i < 6; ++i) qdd[i] = in[0][i];
}

// clang-format off
void sinew_position_of_part(const double* const in[], int count, double* out) { weighted_sum(in, count, out); }
void sinew_velocity_of_part(const double* const in[], int count, double* out) { weighted_sum(in, count, out); }
void sinew_acceleration_of_part(const double* const in[], int count, double* out) { weighted_sum(in, count, out); }
void sinew_force_of_part(const double* const in[], int count, double* out) { weighted_sum(in, count, out); }
void sinew_position_from_leader(const double* const in[], int count, double* out) { weighted_sum(in, count, out); }
void sinew_velocity_from_leader(const double* const in[], int count, double* out) { weighted_sum(in, count, out); }
void sinew_acceleration_from_leader(const double* const in[], int count, double* out) { weighted_sum(in, count, out); }
void sinew_force_of_coupled(const double* const in[], int count, double* out) { weighted_sum(in, count, out); }
void sinew_join_joint_forces(const double* const in[], int count, double* out) { singles(in, count, out); }
void sinew_join_joint_accelerations(const double* const in[], int count, double* out) { singles(in, count, out); }
// clang-format on

void sinew_join_floating_forces(const double* const in[], int count, double* out) {
  for (int i = 0; i < 6; ++i) out[i] = in[0][i];
  singles(in + 1, count - 1, out + 6);
}

void sinew_force_with_rotor(const double* tau, const double* qdd, const double* I, double* out) {
  *out = *tau + *I * *qdd;
}

void sinew_unit_force_with_rotor(const double* D, const double* I, double* out) { *out = *D + *I; }

void sinew_couple_mass_matrix(const double* const in[], int, double* M) {
  const double* const map = in[1];
  const int n = static_cast<int>(map[0]), m = static_cast<int>(map[1]);
  couple_mass_matrix(in[0], map + 2, map + 2 + static_cast<std::size_t>(n) * m, n, m, M);
}

void sinew_couple_jacobian(const double* const in[], int, double* J) { couple(in, 6, J); }
void sinew_couple_analytic_jacobian(const double* const in[], int, double* J) { couple(in, 7, J); }
void sinew_couple_linear_jacobian(const double* const in[], int, double* J) { couple(in, 3, J); }
void sinew_couple_momentum_matrix(const double* const in[], int, double* A) { couple(in, 6, A); }

void sinew_factorise_mass_matrix(const double* const in[], int, double* L) {
  factorise_mass_matrix(L, copy_matrix(in, L));
}

void sinew_decompose_mass_matrix(const double* const in[], int, double* LD) {
  decompose_mass_matrix(LD, copy_matrix(in, LD));
}

void sinew_acceleration_from_decomposition(const double* const in[], int, double* qdd) {
  const int n = static_cast<int>(*in[3]);
  for (int i = 0; i < n; ++i) qdd[i] = in[1][i] - in[2][i];
  solve_decomposed(in[0], n, qdd);
}

void sinew_drive_from_decomposition(const double* const in[], int, double* drive) {
  const int n = static_cast<int>(*in[2]);
  for (int i = 0; i < n; ++i) drive[i] = in[1][i];
  drive_decomposed(in[0], n, drive);
}

void sinew_acceleration_from_drive(const double* const in[], int, double* qdd) {
  const int n = static_cast<int>(*in[2]);
  for (int i = 0; i < n; ++i) qdd[i] = in[1][i];
  accelerate_decomposed(in[0], n, qdd);
}

void sinew_acceleration_energy_of_drives(const double* const in[], int, double* energy) {
  *energy = energy_decomposed(in[0], static_cast<int>(*in[3]), in[1], in[2]);
}

void sinew_weigh_drives(const double* const in[], int count, double* sum) {
  const int n = static_cast<int>(*in[count - 1]), pairs = (count - 1) / 2;
  for (int k = 0; k < n; ++k) {
    sum[k] = 0;
    for (int i = 0; i < pairs; ++i) sum[k] += *in[pairs + i] * in[i][k];
  }
}
