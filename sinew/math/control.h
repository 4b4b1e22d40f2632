// Control laws as pure functions: what a controller keeps from one cycle to the next is among its
// arguments, and its new value is a result. One number in, one number out, but for the impedance of
// a frame. Units are the caller's; they must fit the formula.
#pragma once

#include "sinew/math/choice.h"
#include "sinew/math/rotation_vector.h"
#include "sinew/math/twist.h"
#include "sinew/math/wrench.h"

namespace sinew::math {

// f = f_max - f_max / v_max v: pushes with f_max at rest, not at all at v_max, brakes beyond it.
// S. Schneider et al., Frontiers in Robotics and AI 11 (2024), equation 1.
template <typename S>
S damping_force(const S& v, const S& v_max, const S& f_max) {
  return f_max - f_max / v_max * v;
}

// f = k e - d v, a spring and a damper: N. Hogan, Impedance control (1985), part I, without
// inertia.
template <typename S>
S spring_damper_force(const S& e, const S& v, const S& k, const S& d) {
  return k * e - d * v;
}

// f' = f + m a: the term of an impedance's inertia. Hogan (1985), part I, equation 4, of the errors
// of motion: f = k e + d e' + m e''.
template <typename S>
S force_with_inertia(const S& f, const S& m, const S& a) {
  return f + m * a;
}

// --- Proportional, integral, derivative: K. J. Astrom, T. Hagglund, PID Controllers (1995).

// u = kp e + ki i + kd r, with i the integral and r the rate of e.
template <typename S>
S pid(const S& e, const S& i, const S& r, const S& kp, const S& ki, const S& kd) {
  return kp * e + ki * i + kd * r;
}

// di/dt = e - lambda i by the implicit Euler rule, which is stable for every step:
// i' = (i + e dt) / (1 + lambda dt). With lambda = 0, the plain integral.
template <typename S>
S decaying_integral(const S& i, const S& e, const S& lambda, const S& dt) {
  return (i + e * dt) / (S(1) + lambda * dt);
}

// r = (e - e_before) / dt; zero in the first cycle, which has no e_before.
template <typename S>
S rate(const S& e, const S& e_before, const S& has_before, const S& dt) {
  return choose(S((e - e_before) / dt), S(0), has_before);
}

// u within -limit .. limit.
template <typename S>
S limited(const S& u, const S& limit) {
  return maximum(S(-limit), minimum(u, limit));
}

// Conditional integration (section 3.5 there): while the control u is beyond its limit and the
// error drives it further, the integral stays at i; otherwise it becomes i_next.
template <typename S>
S anti_windup(const S& i, const S& i_next, const S& e, const S& ki, const S& u, const S& limit) {
  const S push = ki * e;
  const S above = select_less(limit, u, select_less(S(0), push, S(1), S(0)), S(0));
  const S below = select_less(u, S(-limit), select_less(push, S(0), S(1), S(0)), S(0));
  return choose(i, i_next, S(above + below));
}

// --- Impedance of a frame.

// One number for each axis of the frame, about and along it: stiffness [N m/rad, N/m] or damping
// [N m s/rad, N s/m].
template <typename S>
struct SpatialGains {
  Vector3<S> angular;
  Vector3<S> linear;
};

// W = K e - D V, all seen from the controlled frame.
template <typename S>
Wrench<S> impedance_wrench(const PoseError<S>& e, const VelocityTwist<S>& V,
                           const SpatialGains<S>& K, const SpatialGains<S>& D) {
  const auto part = [](const Vector3<S>& k, const Vector3<S>& x, const Vector3<S>& d,
                       const Vector3<S>& v) {
    return Vector3<S>{k.x * x.x - d.x * v.x, k.y * x.y - d.y * v.y, k.z * x.z - d.z * v.z};
  };
  return {part(K.angular, e.angular, D.angular, V.angular),
          part(K.linear, e.linear, D.linear, V.linear)};
}

template <typename S>
Wrench<S> wrench_of_torque(const Vector3<S>& line, const S& s) {
  return {s * line, {S(0), S(0), S(0)}};
}

template <typename S>
Wrench<S> wrench_of_force(const Vector3<S>& line, const S& s) {
  return {{S(0), S(0), S(0)}, s * line};
}

// The power of a wrench on a twist about the same point; of a Jacobian's column, the joint's force.
template <typename S>
S power(const VelocityTwist<S>& V, const Wrench<S>& W) {
  return dot(V.angular, W.moment) + dot(V.linear, W.force);
}

template <typename S>
Wrench<S> choose(const Wrench<S>& x, const Wrench<S>& y, const S& flag) {
  const auto part = [&](const Vector3<S>& a, const Vector3<S>& b) {
    return Vector3<S>{choose(a.x, b.x, flag), choose(a.y, b.y, flag), choose(a.z, b.z, flag)};
  };
  return {part(x.moment, y.moment), part(x.force, y.force)};
}

// --- Constraints. The error is what is missing: zero where the constraint holds, and of the sign
// in which the quantity q would have to change.

template <typename S>
S error_of_equality(const S& q, const S& reference) {
  return reference - q;
}

// q > bound
template <typename S>
S error_of_lower_bound(const S& q, const S& bound) {
  return maximum(S(0), S(bound - q));
}

// q < bound
template <typename S>
S error_of_upper_bound(const S& q, const S& bound) {
  return minimum(S(0), S(bound - q));
}

// lower < q < upper
template <typename S>
S error_of_interval(const S& q, const S& lower, const S& upper) {
  return error_of_lower_bound(q, lower) + error_of_upper_bound(q, upper);
}

// --- Monitors.

// |e| <= tolerance
template <typename S>
S holds_within(const S& e, const S& tolerance) {
  return select_less(tolerance, magnitude(e), S(0), S(1));
}

// Set within the tolerance, reset beyond the release tolerance, otherwise as before.
template <typename S>
S holds_with_hysteresis(const S& e, const S& tolerance, const S& release, const S& before) {
  const S a = magnitude(e);
  return select_less(tolerance, a, select_less(release, a, S(0), before), S(1));
}

template <typename S>
S both(const S& a, const S& b) {
  return choose(b, S(0), a);
}

template <typename S>
S either(const S& a, const S& b) {
  return choose(S(1), b, a);
}

template <typename S>
S rising_edge(const S& now, const S& before) {
  return choose(S(S(1) - before), S(0), now);
}

template <typename S>
S falling_edge(const S& now, const S& before) {
  return choose(S(0), before, now);
}

template <typename S>
S any_edge(const S& now, const S& before) {
  return choose(S(S(1) - before), before, now);
}

// --- Guarded motions: 0 waiting, 1 active, 2 done.

template <typename S>
S motion_phase(const S& phase, const S& when, const S& holds, const S& until) {
  const S running = choose(S(2), choose(S(1), S(0), holds), until);
  const S waiting = choose(running, S(0), when);
  return select_less(phase, S(0.5), waiting, select_less(phase, S(1.5), running, S(2)));
}

template <typename S>
S motion_is_active(const S& phase) {
  return select_less(magnitude(S(phase - S(1))), S(0.5), S(1), S(0));
}

// --- Rates: a count that starts again after so many cycles.

template <typename S>
S count_up(const S& count, const S& cycles) {
  const S next = count + S(1);
  return select_less(S(next + S(0.5)), cycles, next, S(0));
}

template <typename S>
S count_is_zero(const S& count) {
  return select_less(count, S(0.5), S(1), S(0));
}

}  // namespace sinew::math
