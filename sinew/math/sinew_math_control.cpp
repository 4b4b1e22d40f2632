#include "sinew/math/sinew_math_control.h"

#include "sinew/math/c_arrays.h"
#include "sinew/math/control.h"

using namespace sinew::math;
using namespace sinew::math::c_arrays;

void sinew_position_along(const double* axis, const double* X, double* out) {
  store(dot(load<Vector3>(axis), load<Pose>(X).p), out);
}

void sinew_angular_velocity_about(const double* axis, const double* V, double* out) {
  store(dot(load<Vector3>(axis), load<VelocityTwist>(V).angular), out);
}

void sinew_linear_velocity_along(const double* axis, const double* V, double* out) {
  store(dot(load<Vector3>(axis), load<VelocityTwist>(V).linear), out);
}

void sinew_angular_acceleration_about(const double* axis, const double* A, double* out) {
  store(dot(load<Vector3>(axis), load<AccelerationTwist>(A).angular), out);
}

void sinew_linear_acceleration_along(const double* axis, const double* A, double* out) {
  store(dot(load<Vector3>(axis), load<AccelerationTwist>(A).linear), out);
}

void sinew_torque_about(const double* axis, const double* W, double* out) {
  store(dot(load<Vector3>(axis), load<Wrench>(W).moment), out);
}

void sinew_force_along(const double* axis, const double* W, double* out) {
  store(dot(load<Vector3>(axis), load<Wrench>(W).force), out);
}

void sinew_wrench_of_torque(const double* line, const double* s, double* W) {
  store(wrench_of_torque(load<Vector3>(line), *s), W);
}

void sinew_wrench_of_force(const double* line, const double* s, double* W) {
  store(wrench_of_force(load<Vector3>(line), *s), W);
}

void sinew_signal_of_joint_position(const double* q, double* out) { store(*q, out); }

void sinew_signal_of_joint_velocity(const double* qd, double* out) { store(*qd, out); }

void sinew_signal_of_joint_acceleration(const double* qdd, double* out) { store(*qdd, out); }

void sinew_joint_acceleration_of_signal(const double* s, double* out) { store(*s, out); }

void sinew_joint_force_of_signal(const double* s, double* out) { store(*s, out); }

void sinew_acceleration_energy_of_signal(const double* s, double* out) { store(*s, out); }

void sinew_acceleration_energy_of_linear_acceleration(const double* a, double* out) {
  store(*a, out);
}

void sinew_acceleration_energy_of_angular_acceleration(const double* al, double* out) {
  store(*al, out);
}

void sinew_joint_force_from_column(const double* column, const double* W, double* out) {
  store(power(load<VelocityTwist>(column), load<Wrench>(W)), out);
}

void sinew_damping(const double* v, const double* v_max, const double* f_max, double* out) {
  store(damping_force(*v, *v_max, *f_max), out);
}

void sinew_spring_damper(const double* e, const double* v, const double* k, const double* d,
                         double* out) {
  store(spring_damper_force(*e, *v, *k, *d), out);
}

void sinew_inertia_force(const double* f, const double* m, const double* a, double* out) {
  store(force_with_inertia(*f, *m, *a), out);
}

void sinew_proportional_integral_derivative(const double* e, const double* i, const double* r,
                                            const double* kp, const double* ki, const double* kd,
                                            double* out) {
  store(pid(*e, *i, *r, *kp, *ki, *kd), out);
}

void sinew_decaying_integral(const double* i, const double* e, const double* lambda,
                             const double* dt, double* out) {
  store(decaying_integral(*i, *e, *lambda, *dt), out);
}

void sinew_rate(const double* e, const double* before, const double* has_before, const double* dt,
                double* out) {
  store(rate(*e, *before, *has_before, *dt), out);
}

void sinew_limit(const double* u, const double* bound, double* out) {
  store(limited(*u, *bound), out);
}

void sinew_anti_windup(const double* i, const double* next, const double* e, const double* ki,
                       const double* u, const double* bound, double* out) {
  store(anti_windup(*i, *next, *e, *ki, *u, *bound), out);
}

void sinew_pose_error(const double* X_RM, const double* X_RD, double* e) {
  store(pose_error(load<Pose>(X_RM), load<Pose>(X_RD)), e);
}

void sinew_impedance(const double* e, const double* V, const double* K, const double* D,
                     double* W) {
  store(impedance_wrench(load<PoseError>(e), load<VelocityTwist>(V), load<SpatialGains>(K),
                         load<SpatialGains>(D)),
        W);
}

void sinew_error_of_equality(const double* q, const double* r, double* out) {
  store(error_of_equality(*q, *r), out);
}

void sinew_error_of_lower_bound(const double* q, const double* t, double* out) {
  store(error_of_lower_bound(*q, *t), out);
}

void sinew_error_of_upper_bound(const double* q, const double* t, double* out) {
  store(error_of_upper_bound(*q, *t), out);
}

void sinew_error_of_interval(const double* q, const double* l, const double* u, double* out) {
  store(error_of_interval(*q, *l, *u), out);
}

void sinew_level(const double* e, const double* tolerance, double* out) {
  store(holds_within(*e, *tolerance), out);
}

void sinew_level_with_hysteresis(const double* e, const double* tolerance, const double* release,
                                 const double* before, double* out) {
  store(holds_with_hysteresis(*e, *tolerance, *release, *before), out);
}

void sinew_rising_edge(const double* now, const double* before, double* out) {
  store(rising_edge(*now, *before), out);
}

void sinew_falling_edge(const double* now, const double* before, double* out) {
  store(falling_edge(*now, *before), out);
}

void sinew_any_edge(const double* now, const double* before, double* out) {
  store(any_edge(*now, *before), out);
}

void sinew_both(const double* a, const double* b, double* out) { store(both(*a, *b), out); }

void sinew_either(const double* a, const double* b, double* out) { store(either(*a, *b), out); }

void sinew_motion_phase(const double* phase, const double* when, const double* holds,
                        const double* until, double* out) {
  store(motion_phase(*phase, *when, *holds, *until), out);
}

void sinew_motion_is_active(const double* phase, double* out) {
  store(motion_is_active(*phase), out);
}

void sinew_choose_signal(const double* x, const double* y, const double* flag, double* out) {
  store(choose(*x, *y, *flag), out);
}

void sinew_choose_flag(const double* x, const double* y, const double* flag, double* out) {
  store(choose(*x, *y, *flag), out);
}

void sinew_choose_wrench(const double* x, const double* y, const double* flag, double* W) {
  store(choose(load<Wrench>(x), load<Wrench>(y), *flag), W);
}

void sinew_count_up(const double* count, const double* cycles, double* out) {
  store(count_up(*count, *cycles), out);
}

void sinew_count_is_zero(const double* count, double* out) { store(count_is_zero(*count), out); }

void sinew_keep_signal(const double* value, double* out) { store(*value, out); }

void sinew_keep_flag(const double* value, double* out) { store(*value, out); }

void sinew_keep_wrench(const double* value, double* W) { store(load<Wrench>(value), W); }
