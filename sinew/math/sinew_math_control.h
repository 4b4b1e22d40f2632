/* The part of the support library that is about tasks: views of single numbers, constraints,
 * monitors, controllers, guarded motions. sinew_math.h includes it. Formulas: math/control.h. A
 * flag is 1 or 0. */
#ifndef SINEW_MATH_CONTROL_H
#define SINEW_MATH_CONTROL_H

#ifdef __cplusplus
extern "C" {
#endif

void sinew_position_along(const double axis[3], const double X[12], double out[1]);
void sinew_angular_velocity_about(const double axis[3], const double V[6], double out[1]);
void sinew_linear_velocity_along(const double axis[3], const double V[6], double out[1]);
void sinew_angular_acceleration_about(const double axis[3], const double A[6], double out[1]);
void sinew_linear_acceleration_along(const double axis[3], const double A[6], double out[1]);
void sinew_torque_about(const double axis[3], const double W[6], double out[1]);
void sinew_force_along(const double axis[3], const double W[6], double out[1]);
void sinew_wrench_of_torque(const double line[3], const double s[1], double W[6]);
void sinew_wrench_of_force(const double line[3], const double s[1], double W[6]);
void sinew_signal_of_joint_position(const double q[1], double out[1]);
void sinew_signal_of_joint_velocity(const double qd[1], double out[1]);
void sinew_signal_of_joint_acceleration(const double qdd[1], double out[1]);
void sinew_joint_acceleration_of_signal(const double s[1], double out[1]);
void sinew_joint_force_of_signal(const double s[1], double out[1]);
void sinew_acceleration_energy_of_signal(const double s[1], double out[1]);
void sinew_acceleration_energy_of_linear_acceleration(const double a[1], double out[1]);
void sinew_acceleration_energy_of_angular_acceleration(const double al[1], double out[1]);
void sinew_joint_force_from_column(const double column[6], const double W[6], double out[1]);
void sinew_damping(const double v[1], const double v_max[1], const double f_max[1], double out[1]);
void sinew_spring_damper(const double e[1], const double v[1], const double k[1], const double d[1],
                         double out[1]);
void sinew_inertia_force(const double f[1], const double m[1], const double a[1], double out[1]);
void sinew_proportional_integral_derivative(const double e[1], const double i[1], const double r[1],
                                            const double kp[1], const double ki[1],
                                            const double kd[1], double out[1]);
void sinew_decaying_integral(const double i[1], const double e[1], const double lambda[1],
                             const double dt[1], double out[1]);
void sinew_rate(const double e[1], const double before[1], const double has_before[1],
                const double dt[1], double out[1]);
void sinew_limit(const double u[1], const double bound[1], double out[1]);
void sinew_anti_windup(const double i[1], const double next[1], const double e[1],
                       const double ki[1], const double u[1], const double bound[1], double out[1]);
void sinew_pose_error(const double X_RM[12], const double X_RD[12], double e[6]);
void sinew_impedance(const double e[6], const double V[6], const double K[6], const double D[6],
                     double W[6]);
void sinew_error_of_equality(const double q[1], const double r[1], double out[1]);
void sinew_error_of_lower_bound(const double q[1], const double t[1], double out[1]);
void sinew_error_of_upper_bound(const double q[1], const double t[1], double out[1]);
void sinew_error_of_interval(const double q[1], const double l[1], const double u[1],
                             double out[1]);
void sinew_level(const double e[1], const double tolerance[1], double out[1]);
void sinew_level_with_hysteresis(const double e[1], const double tolerance[1],
                                 const double release[1], const double before[1], double out[1]);
void sinew_rising_edge(const double now[1], const double before[1], double out[1]);
void sinew_falling_edge(const double now[1], const double before[1], double out[1]);
void sinew_any_edge(const double now[1], const double before[1], double out[1]);
void sinew_both(const double a[1], const double b[1], double out[1]);
void sinew_either(const double a[1], const double b[1], double out[1]);
void sinew_motion_phase(const double phase[1], const double when[1], const double holds[1],
                        const double until[1], double out[1]);
void sinew_motion_is_active(const double phase[1], double out[1]);
void sinew_choose_signal(const double x[1], const double y[1], const double flag[1], double out[1]);
void sinew_choose_flag(const double x[1], const double y[1], const double flag[1], double out[1]);
void sinew_choose_wrench(const double x[6], const double y[6], const double flag[1], double W[6]);
void sinew_count_up(const double count[1], const double cycles[1], double out[1]);
void sinew_count_is_zero(const double count[1], double out[1]);
void sinew_keep_signal(const double value[1], double out[1]);
void sinew_keep_flag(const double value[1], double out[1]);
void sinew_keep_wrench(const double value[6], double W[6]);

#ifdef __cplusplus
}
#endif

#endif
