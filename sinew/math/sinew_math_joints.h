/* The part of the support library that is about joints of several degrees of freedom, joints that
 * follow others, rotors, and factors of the mass matrix. sinew_math.h includes it. Formulas:
 * math/compound_joint.h. Where `count` pointers are taken, the last one is to a map, which begins
 * with how many numbers it is about. */
#ifndef SINEW_MATH_JOINTS_H
#define SINEW_MATH_JOINTS_H

#ifdef __cplusplus
extern "C" {
#endif

/* The pose across the first of the turns that stand for a spherical or floating joint; quaternion
 * x y z w, of a floating joint behind its x y z. */
void sinew_position_to_pose_spherical(const double q[4], double X[12]);
void sinew_position_to_pose_free(const double q[7], double X[12]);
void sinew_velocity_to_twist_spherical(const double qd[3], double V[6]);
void sinew_acceleration_to_twist_spherical(const double qdd[3], double A[6]);
void sinew_spherical_acceleration_of_parts(const double* const in[], int count, double qdd[3]);
void sinew_floating_acceleration_of_parts(const double* const in[], int count, double qdd[6]);
void sinew_floating_acceleration_of_robot(const double* const in[], int count, double qdd[6]);

/* One number from others: map = count, a factor for each, and what is added. */
void sinew_position_of_part(const double* const in[], int count, double out[1]);
void sinew_velocity_of_part(const double* const in[], int count, double out[1]);
void sinew_acceleration_of_part(const double* const in[], int count, double out[1]);
void sinew_force_of_part(const double* const in[], int count, double out[1]);
void sinew_position_from_leader(const double* const in[], int count, double out[1]);
void sinew_velocity_from_leader(const double* const in[], int count, double out[1]);
void sinew_acceleration_from_leader(const double* const in[], int count, double out[1]);
void sinew_force_of_coupled(const double* const in[], int count, double out[1]);

/* Numbers one after the other, without a map; of a floating base first its six. */
void sinew_join_joint_forces(const double* const in[], int count, double* out);
void sinew_join_joint_accelerations(const double* const in[], int count, double* out);
void sinew_join_floating_forces(const double* const in[], int count, double* out);

void sinew_force_with_rotor(const double tau[1], const double qdd[1], const double I[1],
                            double out[1]);
void sinew_unit_force_with_rotor(const double D[1], const double I[1], double out[1]);

/* From matrices of n joints to those of m coordinates: map = n, m, G (n x m), and for the mass
 * matrix the rotors' inertias. */
void sinew_couple_mass_matrix(const double* const in[], int count, double* M);
void sinew_couple_jacobian(const double* const in[], int count, double* J);
void sinew_couple_analytic_jacobian(const double* const in[], int count, double* J);
void sinew_couple_linear_jacobian(const double* const in[], int count, double* J);
void sinew_couple_momentum_matrix(const double* const in[], int count, double* A);

/* Factors of the mass matrix (map = its rows), and qdd = M^-1 (force - bias) by L and D. */
void sinew_factorise_mass_matrix(const double* const in[], int count, double* L);
void sinew_decompose_mass_matrix(const double* const in[], int count, double* LD);
void sinew_acceleration_from_decomposition(const double* const in[], int count, double* qdd);

/* The two halves of that solution, e = L^-T tau and qdd = L^-1 D^-1 e; e_1' D^-1 e_2; and a sum of
 * drives, each as many times as a number says (first the drives, then the numbers). */
void sinew_drive_from_decomposition(const double* const in[], int count, double* drive);
void sinew_acceleration_from_drive(const double* const in[], int count, double* qdd);
void sinew_acceleration_energy_of_drives(const double* const in[], int count, double energy[1]);
void sinew_weigh_drives(const double* const in[], int count, double* sum);

#ifdef __cplusplus
}
#endif

#endif
