// Choices without branches: formulas of `math` call these, so that a tracing scalar
// (program/dag/traced.h) can record them and generated code always does the same work. A flag is a
// number, 1 or 0.
#pragma once

#include "sinew/math/select.h"

namespace sinew::math {

template <typename S>
S minimum(const S& a, const S& b) {
  return select_less(a, b, a, b);
}

template <typename S>
S maximum(const S& a, const S& b) {
  return select_less(a, b, b, a);
}

template <typename S>
S magnitude(const S& a) {
  return maximum(a, S(-a));
}

// `x` where the flag is set, otherwise `y`.
template <typename S>
S choose(const S& x, const S& y, const S& flag) {
  return select_less(S(0.5), flag, x, y);
}

}  // namespace sinew::math
