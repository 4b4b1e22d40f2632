// The C support library's arrays as values of `math`, and back (layout.h).
#pragma once

#include "sinew/math/layout.h"

namespace sinew::math::c_arrays {

template <template <typename> typename T>
T<double> load(const double* at) {
  return Layout<T<double>>::load(at);
}

template <typename T>
void store(const T& value, double* at) {
  Layout<T>::store(value, at);
}

}  // namespace sinew::math::c_arrays
