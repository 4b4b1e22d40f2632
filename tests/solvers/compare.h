// How far two answers are apart.
#pragma once

#include <algorithm>
#include <cmath>

#include "peer.h"

namespace sinew::test {

inline double largest(const peers::Vector& numbers) {
  double result = 0;
  for (const double number : numbers) result = std::max(result, std::fabs(number));
  return result;
}

// The largest difference, relative to the largest number (but at least to 1).
inline double difference(const peers::Vector& a, const peers::Vector& b) {
  if (a.size() != b.size()) return 1e300;
  double result = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double apart = std::fabs(a[i] - b[i]);
    if (!(apart <= result)) result = apart;  // also what is no number
  }
  return std::isnan(result) ? 1e300 : result / std::max(1.0, largest(b));
}

}  // namespace sinew::test
