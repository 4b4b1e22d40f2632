#include "sinew/program/kernels_control.h"

#include "sinew/math/control.h"
#include "sinew/program/kernel_row.h"

namespace sinew::program {

using namespace sinew::math;

std::vector<Kernel> kernels_of_control() {
  return {
      row("position-along",
          []<typename S>(const Vector3<S>& axis, const Pose<S>& X) { return dot(axis, X.p); }),
      row("angular-velocity-about",
          []<typename S>(const Vector3<S>& axis, const VelocityTwist<S>& V) {
            return dot(axis, V.angular);
          }),
      row("linear-velocity-along",
          []<typename S>(const Vector3<S>& axis, const VelocityTwist<S>& V) {
            return dot(axis, V.linear);
          }),
      row("angular-acceleration-about",
          []<typename S>(const Vector3<S>& axis, const AccelerationTwist<S>& A) {
            return dot(axis, A.angular);
          }),
      row("linear-acceleration-along",
          []<typename S>(const Vector3<S>& axis, const AccelerationTwist<S>& A) {
            return dot(axis, A.linear);
          }),
      row("torque-about", []<typename S>(const Vector3<S>& axis,
                                         const Wrench<S>& W) { return dot(axis, W.moment); }),
      row("force-along", []<typename S>(const Vector3<S>& axis,
                                        const Wrench<S>& W) { return dot(axis, W.force); }),
      row("wrench-of-torque",
          []<typename S>(const Vector3<S>& line, const S& s) { return wrench_of_torque(line, s); }),
      row("wrench-of-force",
          []<typename S>(const Vector3<S>& line, const S& s) { return wrench_of_force(line, s); }),
      row("signal-of-joint-position", []<typename S>(const S& q) { return q; }),
      row("signal-of-joint-velocity", []<typename S>(const S& qd) { return qd; }),
      row("signal-of-joint-acceleration", []<typename S>(const S& qdd) { return qdd; }),
      row("joint-acceleration-of-signal", []<typename S>(const S& s) { return s; }),
      row("joint-force-of-signal", []<typename S>(const S& s) { return s; }),
      row("acceleration-energy-of-signal", []<typename S>(const S& s) { return s; }),
      row("acceleration-energy-of-linear-acceleration", []<typename S>(const S& s) { return s; }),
      row("acceleration-energy-of-angular-acceleration", []<typename S>(const S& s) { return s; }),
      row("joint-force-from-column",
          []<typename S>(const VelocityTwist<S>& column, const Wrench<S>& W) {
            return power(column, W);
          }),
      row("damping", []<typename S>(const S& v, const S& v_max,
                                    const S& f_max) { return damping_force(v, v_max, f_max); }),
      row("spring-damper", []<typename S>(const S& e, const S& v, const S& k,
                                          const S& d) { return spring_damper_force(e, v, k, d); }),
      row("inertia-force", []<typename S>(const S& f, const S& m,
                                          const S& a) { return force_with_inertia(f, m, a); }),
      row("proportional-integral-derivative",
          []<typename S>(const S& e, const S& i, const S& r, const S& kp, const S& ki,
                         const S& kd) { return pid(e, i, r, kp, ki, kd); }),
      row("decaying-integral",
          []<typename S>(const S& i, const S& e, const S& lambda, const S& dt) {
            return decaying_integral(i, e, lambda, dt);
          }),
      row("rate", []<typename S>(const S& e, const S& before, const S& has_before,
                                 const S& dt) { return rate(e, before, has_before, dt); }),
      row("limit", []<typename S>(const S& u, const S& bound) { return limited(u, bound); }),
      row("anti-windup",
          []<typename S>(const S& i, const S& next, const S& e, const S& ki, const S& u,
                         const S& bound) { return anti_windup(i, next, e, ki, u, bound); }),
      row("pose-error", []<typename S>(const Pose<S>& X_RM,
                                       const Pose<S>& X_RD) { return pose_error(X_RM, X_RD); }),
      row("impedance",
          []<typename S>(const PoseError<S>& e, const VelocityTwist<S>& V, const SpatialGains<S>& K,
                         const SpatialGains<S>& D) { return impedance_wrench(e, V, K, D); }),
      row("error-of-equality",
          []<typename S>(const S& q, const S& r) { return error_of_equality(q, r); }),
      row("error-of-lower-bound",
          []<typename S>(const S& q, const S& t) { return error_of_lower_bound(q, t); }),
      row("error-of-upper-bound",
          []<typename S>(const S& q, const S& t) { return error_of_upper_bound(q, t); }),
      row("error-of-interval", []<typename S>(const S& q, const S& l,
                                              const S& u) { return error_of_interval(q, l, u); }),
      row("level",
          []<typename S>(const S& e, const S& tolerance) { return holds_within(e, tolerance); }),
      row("level-with-hysteresis",
          []<typename S>(const S& e, const S& tolerance, const S& release, const S& before) {
            return holds_with_hysteresis(e, tolerance, release, before);
          }),
      row("rising-edge",
          []<typename S>(const S& now, const S& before) { return rising_edge(now, before); }),
      row("falling-edge",
          []<typename S>(const S& now, const S& before) { return falling_edge(now, before); }),
      row("any-edge",
          []<typename S>(const S& now, const S& before) { return any_edge(now, before); }),
      row("both", []<typename S>(const S& a, const S& b) { return both(a, b); }),
      row("either", []<typename S>(const S& a, const S& b) { return either(a, b); }),
      row("motion-phase",
          []<typename S>(const S& phase, const S& when, const S& holds, const S& until) {
            return motion_phase(phase, when, holds, until);
          }),
      row("motion-is-active", []<typename S>(const S& phase) { return motion_is_active(phase); }),
      row("choose-signal",
          []<typename S>(const S& x, const S& y, const S& flag) { return choose(x, y, flag); }),
      row("choose-flag",
          []<typename S>(const S& x, const S& y, const S& flag) { return choose(x, y, flag); }),
      row("choose-wrench", []<typename S>(const Wrench<S>& x, const Wrench<S>& y,
                                          const S& flag) { return choose(x, y, flag); }),
      row("count-up",
          []<typename S>(const S& count, const S& cycles) { return count_up(count, cycles); }),
      row("count-is-zero", []<typename S>(const S& count) { return count_is_zero(count); }),
      row("keep-signal", []<typename S>(const S& value) { return value; }),
      row("keep-flag", []<typename S>(const S& value) { return value; }),
      row("keep-wrench", []<typename S>(const Wrench<S>& value) { return value; }),
  };
}

}  // namespace sinew::program
