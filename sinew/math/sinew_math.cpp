// The C support library: the functions of `math` for double, with C linkage. It needs no C++
// runtime.
#include "sinew/math/sinew_math.h"

#include "sinew/math/articulated_inertia.h"
#include "sinew/math/c_arrays.h"
#include "sinew/math/floating.h"
#include "sinew/math/inertia.h"
#include "sinew/math/jacobian.h"
#include "sinew/math/joint.h"
#include "sinew/math/momentum.h"

using namespace sinew::math;
using namespace sinew::math::c_arrays;

// clang-format off
void sinew_position_to_pose_revolute(const double* q, double* X) { store(revolute_pose(*q), X); }
void sinew_position_to_pose_prismatic(const double* q, double* X) { store(prismatic_pose(*q), X); }
void sinew_velocity_to_twist_revolute(const double* qd, double* V) { store(revolute_velocity(*qd), V); }
void sinew_velocity_to_twist_prismatic(const double* qd, double* V) { store(prismatic_velocity(*qd), V); }
void sinew_acceleration_to_twist_revolute(const double* qdd, double* A) { store(revolute_acceleration(*qdd), A); }
void sinew_acceleration_to_twist_prismatic(const double* qdd, double* A) { store(prismatic_acceleration(*qdd), A); }
void sinew_force_from_wrench_revolute(const double* W, double* tau) { store(revolute_force(load<Wrench>(W)), tau); }
void sinew_force_from_wrench_prismatic(const double* W, double* tau) { store(prismatic_force(load<Wrench>(W)), tau); }
// clang-format on

void sinew_compose_pose(const double* X_AB, const double* X_BC, double* X_AC) {
  store(compose(load<Pose>(X_AB), load<Pose>(X_BC)), X_AC);
}

void sinew_invert_pose(const double* X_AB, double* X_BA) { store(invert(load<Pose>(X_AB)), X_BA); }

void sinew_transform_velocity_twist_to_distal(const double* X_AB, const double* V_A, double* V_B) {
  store(transform_to_distal(load<Pose>(X_AB), load<VelocityTwist>(V_A)), V_B);
}

void sinew_transform_acceleration_twist_to_distal_fixed(const double* X_AB, const double* V_A,
                                                        const double* A_A, double* A_B) {
  store(transform_to_distal_fixed(load<Pose>(X_AB), load<VelocityTwist>(V_A),
                                  load<AccelerationTwist>(A_A)),
        A_B);
}

void sinew_transform_acceleration_twist_to_distal(const double* X_AB, const double* V_A,
                                                  const double* V_rel, const double* A_A,
                                                  double* A_B) {
  store(transform_to_distal(load<Pose>(X_AB), load<VelocityTwist>(V_A), load<VelocityTwist>(V_rel),
                            load<AccelerationTwist>(A_A)),
        A_B);
}

void sinew_add_velocity_twist(const double* a, const double* b, double* c) {
  store(add(load<VelocityTwist>(a), load<VelocityTwist>(b)), c);
}

void sinew_add_acceleration_twist(const double* a, const double* b, double* c) {
  store(add(load<AccelerationTwist>(a), load<AccelerationTwist>(b)), c);
}

void sinew_transform_acceleration_twist_to_distal_at_rest(const double* X_AB, const double* A_A,
                                                          double* A_B) {
  store(transform_to_distal_at_rest(load<Pose>(X_AB), load<AccelerationTwist>(A_A)), A_B);
}

void sinew_rotate_velocity_twist_to_proximal(const double* X_AB, const double* V_B, double* V_A) {
  store(rotate_to_proximal(load<Pose>(X_AB), load<VelocityTwist>(V_B)), V_A);
}

void sinew_rotate_velocity_twist_to_distal(const double* X_AB, const double* V_A, double* V_B) {
  store(rotate_to_distal(load<Pose>(X_AB), load<VelocityTwist>(V_A)), V_B);
}

void sinew_rotate_acceleration_twist_to_proximal(const double* X_AB, const double* A_B,
                                                 double* A_A) {
  store(rotate_to_proximal(load<Pose>(X_AB), load<AccelerationTwist>(A_B)), A_A);
}

void sinew_rotate_acceleration_twist_to_distal(const double* X_AB, const double* A_A, double* A_B) {
  store(rotate_to_distal(load<Pose>(X_AB), load<AccelerationTwist>(A_A)), A_B);
}

void sinew_newton_euler_wrench(const double* I, const double* V, const double* A, double* W) {
  store(newton_euler(load<RigidBodyInertia>(I), load<VelocityTwist>(V), load<AccelerationTwist>(A)),
        W);
}

void sinew_newton_euler_wrench_across_revolute(const double* X_AB, const double* I_B,
                                               const double* V_A, const double* V_rel,
                                               const double* A_A, const double* A_rel,
                                               double* W_A) {
  store(newton_euler_across_revolute(load<Pose>(X_AB), load<RigidBodyInertia>(I_B),
                                     load<VelocityTwist>(V_A), load<VelocityTwist>(V_rel),
                                     load<AccelerationTwist>(A_A), load<AccelerationTwist>(A_rel)),
        W_A);
}

void sinew_acceleration_twist_to_wrench(const double* I, const double* A, double* W) {
  store(newton_euler_at_rest(load<RigidBodyInertia>(I), load<AccelerationTwist>(A)), W);
}

void sinew_acceleration_twist_to_wrench_across_revolute(const double* X_AB, const double* I_B,
                                                        const double* A_A, const double* A_rel,
                                                        double* W_A) {
  store(newton_euler_at_rest_across_revolute(load<Pose>(X_AB), load<RigidBodyInertia>(I_B),
                                             load<AccelerationTwist>(A_A),
                                             load<AccelerationTwist>(A_rel)),
        W_A);
}

void sinew_transform_wrench_to_proximal(const double* X_AB, const double* W_B, double* W_A) {
  store(transform_to_proximal(load<Pose>(X_AB), load<Wrench>(W_B)), W_A);
}

void sinew_accumulate_wrench(const double* a, const double* b, double* c) {
  store(add(load<Wrench>(a), load<Wrench>(b)), c);
}

void sinew_rotate_wrench_to_proximal(const double* X_AB, const double* W_B, double* W_A) {
  store(rotate_to_proximal(load<Pose>(X_AB), load<Wrench>(W_B)), W_A);
}

void sinew_rotate_wrench_to_distal(const double* X_AB, const double* W_A, double* W_B) {
  store(rotate_to_distal(load<Pose>(X_AB), load<Wrench>(W_A)), W_B);
}

void sinew_transform_rigid_body_inertia_to_proximal(const double* X_AB, const double* I_B,
                                                    double* I_A) {
  store(transform_to_proximal(load<Pose>(X_AB), load<RigidBodyInertia>(I_B)), I_A);
}

void sinew_accumulate_rigid_body_inertia(const double* a, const double* b, double* c) {
  store(add(load<RigidBodyInertia>(a), load<RigidBodyInertia>(b)), c);
}

void sinew_articulated_from_rigid_body_inertia(const double* I, double* IA) {
  store(articulated(load<RigidBodyInertia>(I)), IA);
}

void sinew_transform_articulated_body_inertia_to_proximal(const double* X_AB, const double* I_B,
                                                          double* I_A) {
  store(transform_to_proximal(load<Pose>(X_AB), load<ArticulatedInertia>(I_B)), I_A);
}

void sinew_accumulate_articulated_body_inertia(const double* a, const double* b, double* c) {
  store(add(load<ArticulatedInertia>(a), load<ArticulatedInertia>(b)), c);
}

void sinew_wrench_of_revolute_from_rigid_body_inertia(const double* I, double* U) {
  store(wrench_of_revolute(load<RigidBodyInertia>(I)), U);
}

void sinew_wrench_of_prismatic_from_rigid_body_inertia(const double* I, double* U) {
  store(wrench_of_prismatic(load<RigidBodyInertia>(I)), U);
}

void sinew_wrench_of_revolute_from_articulated_body_inertia(const double* I, double* U) {
  store(wrench_of_revolute(load<ArticulatedInertia>(I)), U);
}

void sinew_wrench_of_prismatic_from_articulated_body_inertia(const double* I, double* U) {
  store(wrench_of_prismatic(load<ArticulatedInertia>(I)), U);
}

void sinew_project_articulated_body_inertia(const double* I, const double* U, const double* D,
                                            double* I_a) {
  store(project(load<ArticulatedInertia>(I), load<Wrench>(U), *D), I_a);
}

void sinew_project_wrench(const double* W, const double* U, const double* D, const double* u,
                          double* W_a) {
  store(project(load<Wrench>(W), load<Wrench>(U), *D, *u), W_a);
}

void sinew_joint_acceleration_from_force(const double* u, const double* U, const double* D,
                                         const double* A, double* qdd) {
  store(joint_acceleration(*u, load<Wrench>(U), *D, load<AccelerationTwist>(A)), qdd);
}

void sinew_subtract_joint_force(const double* a, const double* b, double* c) { *c = *a - *b; }

void sinew_jacobian_column_revolute(const double* X_RC, const double* X_RB, double* J) {
  store(jacobian_column_revolute(load<Pose>(X_RC), load<Pose>(X_RB)), J);
}

void sinew_jacobian_column_prismatic(const double* X_RC, const double* X_RB, double* J) {
  store(jacobian_column_prismatic(load<Pose>(X_RC), load<Pose>(X_RB)), J);
}

void sinew_mass_matrix_from_entries(const double* const entries[], int count, double* M) {
  for (int i = 0; i < count; ++i) M[i] = *entries[i];
}

void sinew_jacobian_from_columns(const double* const columns[], int count, double* J) {
  for (int column = 0; column < count; ++column)
    for (int row = 0; row < 6; ++row) J[row * count + column] = columns[column][row];
}

void sinew_position_to_pose_floating(const double* q, double* X) {
  store(floating_pose(load<FloatingPosition>(q)), X);
}

void sinew_velocity_to_twist_floating(const double* qd, double* V) {
  store(load<VelocityTwist>(qd), V);
}

void sinew_acceleration_to_twist_floating(const double* qdd, const double* V, double* A) {
  store(floating_acceleration(load<AccelerationTwist>(qdd), load<VelocityTwist>(V)), A);
}

void sinew_force_from_wrench_floating(const double* W, double* f) { store(load<Wrench>(W), f); }

void sinew_subtract_floating_force(const double* a, const double* b, double* c) {
  for (int i = 0; i < 6; ++i) c[i] = a[i] - b[i];
}

void sinew_floating_acceleration_from_force(const double* I, const double* u, double* qdd) {
  store(solve(load<ArticulatedInertia>(I), load<Wrench>(u)), qdd);
}

void sinew_jacobian_columns_floating(const double* X_RC, const double* X_RB, double* J) {
  store(jacobian_columns_floating(load<Pose>(X_RC), load<Pose>(X_RB)), J);
}

void sinew_floating_jacobian_from_columns(const double* const columns[], int count, double* J) {
  const int width = 6 + count - 1;
  for (int row = 0; row < 6; ++row) {
    for (int k = 0; k < 6; ++k) J[row * width + k] = columns[0][6 * k + row];
    for (int j = 1; j < count; ++j) J[row * width + 5 + j] = columns[j][row];
  }
}

void sinew_floating_mass_matrix_from_parts(const double* const parts[], int count, double* M) {
  int n = 0;
  while (1 + n + n * n < count) ++n;
  const int width = 6 + n;
  const RigidBodyInertia<double> I = load<RigidBodyInertia>(parts[0]);
  for (int c = 0; c < 6; ++c) {
    double unit[6] = {};
    unit[c] = 1;
    double column[6];
    store(newton_euler_at_rest(I, load<AccelerationTwist>(unit)), column);
    for (int r = 0; r < 6; ++r) M[r * width + c] = column[r];
  }
  for (int j = 0; j < n; ++j) {
    for (int r = 0; r < 6; ++r) M[r * width + 6 + j] = M[(6 + j) * width + r] = parts[1 + j][r];
    for (int c = 0; c < n; ++c) M[(6 + j) * width + 6 + c] = *parts[1 + n + j * n + c];
  }
}

void sinew_momentum_from_velocity_twist(const double* I, const double* V, double* P) {
  store(momentum(load<RigidBodyInertia>(I), load<VelocityTwist>(V)), P);
}

void sinew_transform_momentum_to_proximal(const double* X_AB, const double* P_B, double* P_A) {
  store(transform_to_proximal(load<Pose>(X_AB), load<Momentum>(P_B)), P_A);
}

void sinew_accumulate_momentum(const double* a, const double* b, double* c) {
  store(add(load<Momentum>(a), load<Momentum>(b)), c);
}

void sinew_kinetic_energy_from_momentum(const double* V, const double* P, double* T) {
  *T = kinetic_energy(load<VelocityTwist>(V), load<Momentum>(P));
}

void sinew_add_energy(const double* a, const double* b, double* c) { *c = *a + *b; }

void sinew_potential_energy_from_rigid_body_inertia(const double* I, const double* A, double* E) {
  *E = potential_energy(load<RigidBodyInertia>(I), load<AccelerationTwist>(A));
}

void sinew_center_of_mass_from_rigid_body_inertia(const double* I, double* p) {
  store(center_of_mass(load<RigidBodyInertia>(I)), p);
}

void sinew_center_of_mass_velocity_from_momentum(const double* I, const double* P, double* v) {
  store(center_of_mass_velocity(load<RigidBodyInertia>(I), load<Momentum>(P)), v);
}

void sinew_center_of_mass_column_revolute(const double* X, const double* I, const double* total,
                                          double* J) {
  store(center_of_mass_column_revolute(load<Pose>(X), load<RigidBodyInertia>(I),
                                       load<RigidBodyInertia>(total)),
        J);
}

void sinew_center_of_mass_column_prismatic(const double* X, const double* I, const double* total,
                                           double* J) {
  store(center_of_mass_column_prismatic(load<Pose>(X), load<RigidBodyInertia>(I),
                                        load<RigidBodyInertia>(total)),
        J);
}

void sinew_center_of_mass_columns_floating(const double* X, const double* I, const double* total,
                                           double* J) {
  store(center_of_mass_columns_floating(load<Pose>(X), load<RigidBodyInertia>(I),
                                        load<RigidBodyInertia>(total)),
        J);
}

void sinew_linear_jacobian_from_columns(const double* const columns[], int count, double* J) {
  for (int column = 0; column < count; ++column)
    for (int row = 0; row < 3; ++row) J[row * count + column] = columns[column][row];
}

void sinew_floating_linear_jacobian_from_columns(const double* const columns[], int count,
                                                 double* J) {
  const int width = 6 + count - 1;
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 6; ++k) J[row * width + k] = columns[0][3 * k + row];
    for (int j = 1; j < count; ++j) J[row * width + 5 + j] = columns[j][row];
  }
}

void sinew_momentum_about_center_of_mass(const double* P, const double* c, double* P_c) {
  store(about(load<Momentum>(P), load<Vector3>(c)), P_c);
}

void sinew_centroidal_momentum_column_revolute(const double* X, const double* I, const double* c,
                                               double* A) {
  store(centroidal_momentum_column_revolute(load<Pose>(X), load<RigidBodyInertia>(I),
                                            load<Vector3>(c)),
        A);
}

void sinew_centroidal_momentum_column_prismatic(const double* X, const double* I, const double* c,
                                                double* A) {
  store(centroidal_momentum_column_prismatic(load<Pose>(X), load<RigidBodyInertia>(I),
                                             load<Vector3>(c)),
        A);
}

void sinew_centroidal_momentum_columns_floating(const double* X, const double* I, const double* c,
                                                double* A) {
  store(centroidal_momentum_columns_floating(load<Pose>(X), load<RigidBodyInertia>(I),
                                             load<Vector3>(c)),
        A);
}

void sinew_momentum_matrix_from_columns(const double* const columns[], int count, double* A) {
  sinew_jacobian_from_columns(columns, count, A);
}

void sinew_floating_momentum_matrix_from_columns(const double* const columns[], int count,
                                                 double* A) {
  sinew_floating_jacobian_from_columns(columns, count, A);
}

void sinew_base_acceleration_from_gravity(const double* g, double* A) {
  store(base_acceleration(load<Vector3>(g)), A);
}

void sinew_free_fall_from_gravity(const double* /*X*/, const double* g, double* A) {
  store(free_fall(load<Vector3>(g)), A);
}
