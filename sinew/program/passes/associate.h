// Turns a sum of products back into binary operations, in an order of choice.
#pragma once

#include <span>
#include <vector>

#include "sinew/program/dag/dag.h"
#include "sinew/program/passes/latency.h"
#include "sinew/program/passes/polynomials.h"

namespace sinew::program {

class Associator {
 public:
  Associator(Dag& dag, Association association)
      : dag_(dag), ready_(dag), association_(association) {}

  // The sum to be made: first nothing, then term by term.
  void begin() {
    values_.clear();
    products_.clear();
  }
  // `copy_of(factor)`: the node of the graph that is being made. `alone`: there is no other term.
  template <typename CopyOf>
  void add(double coefficient, std::span<const std::uint32_t> factors, bool alone, CopyOf copy_of) {
    factors_.clear();
    for (const std::uint32_t factor : factors) factors_.push_back(timed(copy_of(factor)));
    add(coefficient, alone);
  }
  // `deadline`: when the sum has to be ready; of use for kFused only. Precondition: not kPlain.
  Ref end(double deadline);

 private:
  struct Timed {
    Ref ref;
    double ready;
  };
  // Two factors that are still to be multiplied.
  struct Product {
    Ref a, b;
    double ready;
  };

  Timed timed(Ref ref) { return {ref, ready_.of(ref)}; }
  void add(double coefficient, bool alone);
  Ref multiply(double coefficient, std::span<const Timed> factors);
  Ref shallow_sum();
  Ref fused_sum(double deadline);
  double chain_time();

  Dag& dag_;
  ReadyTimes ready_;
  Association association_;
  std::vector<Timed> factors_;  // of the term that is being added
  std::vector<Timed> values_;   // terms
  std::vector<Product> products_;
  std::vector<double> times_;
};

}  // namespace sinew::program
