// What the constrained recursion adds to the articulated-body algorithm: how a wrench on a body
// goes on to its predecessor through a joint that gives way, and the acceleration energy of forces
// (Vereshchagin 1989, equations b to e; Shakhimardanov 2015, section 2.4).
#pragma once

#include "sinew/math/articulated_inertia.h"
#include "sinew/math/select.h"

namespace sinew::math {

// The joint accelerates by `qdd` under the force that reaches it; what is left of the wrench F goes
// on: F - U qdd, with U the wrench of one unit of joint acceleration.
template <typename S>
Wrench<S> release(const Wrench<S>& F, const Wrench<S>& U, const S& qdd) {
  return {F.moment - qdd * U.moment, F.force - qdd * U.force};
}

template <typename S>
Wrench<S> subtract(const Wrench<S>& a, const Wrench<S>& b) {
  return {a.moment - b.moment, a.force - b.force};
}

// Force times acceleration [N m/s^2]: what Gauss' principle minimises is made of it.
template <typename S>
S acceleration_energy(const Wrench<S>& F, const AccelerationTwist<S>& A) {
  return dot(F.moment, A.angular) + dot(F.force, A.linear);
}

// The share of one driver that saturates no actuator: the largest s in [0, 1], coming down from 1,
// for which |rest_j + s scaled_j| <= limit_j for every j; 0 where there is none. `a(j)`, `b(j)`,
// `limit(j)` give rest, scaled and limit.
template <typename S, typename A, typename B, typename L>
S scale_within_limits(int count, A rest, B scaled, L limit) {
  const S zero(0), one(1);
  S lower = zero, upper = one;
  for (int j = 0; j < count; ++j) {
    const S a = rest(j), b = scaled(j);
    // Towards which limit it goes; without any effect, s is free or nothing helps.
    const S size = select_less(b, zero, -b, b);
    const S towards = select_less(b, zero, -a, a);
    const S divisor = select_less(zero, size, size, one);
    const S high = (limit(j) - towards) / divisor;  // s beyond which it saturates
    const S low = (-limit(j) - towards) / divisor;  // s below which it saturates the other way
    const S within = select_less(limit(j), select_less(a, zero, -a, a), -one, one);
    const S bound_above = select_less(zero, size, high, within);
    const S bound_below = select_less(zero, size, low, zero);
    upper = select_less(bound_above, upper, bound_above, upper);
    lower = select_less(lower, bound_below, bound_below, lower);
  }
  // Nothing between them: no share keeps every actuator within its limit.
  return select_less(upper, lower, zero, select_less(upper, zero, zero, upper));
}

}  // namespace sinew::math
