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
using SignedProducts = PooledVector<SignedProduct>;

class Associator {
 public:
  Associator(Dag& dag, Association association)
      : dag_(dag), ready_(dag), association_(association) {}

  // `deadline`: when the sum has to be ready; of use for kFused only. Precondition: not kPlain.
  Ref sum(SignedProducts& terms, double deadline);

 private:
  // Two factors that are still to be multiplied.
  struct Product {
    Ref a, b;
    double ready = 0.0;
  };

  Ref multiply(SignedProduct& term, std::size_t first, std::size_t last);
  using Values = SmallList<Ref, 8>;
  using Products = SmallList<Product, 8>;

  Ref shallow_sum(Values& values);
  Ref fused_sum(Values& values, Products& products, double deadline);
  double chain_time(const Values& values, const Products& products);
  void combine_first_two(Values& values);

  Dag& dag_;
  ReadyTimes ready_;
  Association association_;
};

}  // namespace sinew::program
