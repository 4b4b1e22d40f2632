// Turns a sum of products back into binary operations, in an order of choice.
#pragma once

#include <vector>

#include "sinew/program/dag/dag.h"
#include "sinew/program/passes/latency.h"
#include "sinew/program/passes/polynomials.h"
#include "sinew/program/passes/small_list.h"

namespace sinew::program {

struct SignedProduct {
  double coefficient = 1.0;
  SmallList<Ref, 4> factors;
};

class Associator {
 public:
  Associator(Dag& dag, Association association)
      : dag_(dag), ready_(dag), association_(association) {}

  // `deadline`: when the sum has to be ready; of use for kFused only.
  Ref sum(std::vector<SignedProduct> terms, double deadline);

 private:
  // Two factors that are still to be multiplied.
  struct Product {
    Ref a, b;
    double ready = 0.0;
  };

  Ref multiply(SignedProduct& term, std::size_t first, std::size_t last);
  Ref shallow_sum(std::vector<Ref> values);
  Ref fused_sum(std::vector<Ref> values, std::vector<Product> products, double deadline);
  double chain_time(const std::vector<Ref>& values, const std::vector<Product>& products);
  void combine_first_two(std::vector<Ref>& values);

  Dag& dag_;
  ReadyTimes ready_;
  Association association_;
};

}  // namespace sinew::program
