// A choice between two numbers that is no branch: both are computed, one is taken. Formulas call it
// so that they take the same steps whatever the numbers are, and can be recorded once for all
// (program/dag/traced.h has the recording one).
#pragma once

namespace sinew::math {

// `x` where a < b, otherwise `y`; also where a or b is no number.
inline double select_less(double a, double b, double x, double y) { return a < b ? x : y; }

}  // namespace sinew::math
