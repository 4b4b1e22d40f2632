// Graphs for the tests of the passes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "sinew/program/dag/dag.h"

namespace sinew::program {

// Sums and products of a few inputs with few constants, so that terms meet often.
inline Computation random_computation(unsigned seed) {
  std::mt19937 generator(seed);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(generator() % n); };
  Computation c;
  c.inputs = 6;
  std::vector<Ref> values;
  for (std::uint32_t i = 0; i < c.inputs; ++i) values.push_back(c.dag.input(i));
  for (const double constant : {0.5, 2.0, -3.0, 1.0 / 3.0})
    values.push_back(c.dag.constant(constant));
  values.push_back(c.dag.sin(values[0]));
  values.push_back(c.dag.cos(values[1]));
  const auto pick = [&] {
    const std::uint32_t recent = std::min<std::uint32_t>(values.size(), 12);
    const std::size_t i = below(3) == 0 ? below(values.size()) : values.size() - 1 - below(recent);
    return values[i].negated_if(below(4) == 0);
  };
  for (int k = 0; k < 120; ++k) {
    c.dag.set_origin(k / 10);
    switch (below(20)) {
      case 0: {
        // A denominator that stays away from zero.
        const Ref a = pick();
        values.push_back(
            c.dag.divide(pick(), c.dag.add(c.dag.constant(1.5), c.dag.multiply(a, a))));
        break;
      }
      case 1: {
        const Ref a = pick();
        values.push_back(c.dag.sqrt(c.dag.add(c.dag.constant(1.0), c.dag.multiply(a, a))));
        break;
      }
      case 2:
        values.push_back(c.dag.select(c.dag.less(c.dag.input(2), c.dag.input(3)), pick(), pick()));
        break;
      default:
        values.push_back(below(2) == 0 ? c.dag.add(pick(), pick())
                                       : c.dag.multiply(pick(), pick()));
    }
    if (k % 6 == 5) {
      // Values stay of order one, so that round-off does.
      const Ref v = values.back();
      values.back() = c.dag.divide(v, c.dag.add(c.dag.constant(1.0), c.dag.multiply(v, v)));
    }
  }
  for (int k = 0; k < 8; ++k) c.results.push_back(values[values.size() - 1 - 3 * k]);
  c.results.push_back(-c.results.front());
  c.results.push_back(c.dag.constant(-2.5));
  c.results.push_back(c.dag.input(4));
  return c;
}

}  // namespace sinew::program
