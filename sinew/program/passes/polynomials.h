// A graph seen as polynomials: additions and multiplications whose results nobody else uses are
// taken up into the sums that they are part of, whatever the order in which they were written. The
// passes that rearrange sums work on this form; writing it back makes additions and multiplications
// again.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/program/dag/dag.h"
#include "sinew/program/passes/small_list.h"

namespace sinew::program {

// coefficient * product of factors; the factors are numbers of nodes, sorted, repeated for powers.
// Without factors it is a constant.
using Factors = SmallList<std::uint32_t, 4>;

struct Monomial {
  double coefficient = 1.0;
  Factors factors;
};

using Monomials = PooledVector<Monomial>;

struct Polynomial {
  Monomials terms;
  std::uint32_t origin = kNoOrigin;
};

// Node i is what node i of the graph was, either a polynomial of other nodes or the operation that
// it was; the nodes behind those of the graph are polynomials that passes have added.
struct Polynomials {
  Computation graph;
  std::vector<bool> is_polynomial;
  std::vector<Polynomial> polynomial;  // of each node; empty where it is none, or has been taken up

  // A new node for a polynomial.
  std::uint32_t add(Polynomial polynomial);
};

Polynomials read_polynomials(Computation graph);

// How often each node is used by live nodes and results; 0 for a dead one.
std::vector<std::uint32_t> use_counts(const Polynomials& system);

// Adds terms of the same factors together and drops those that cancel.
void collect_terms(Polynomial& polynomial);

// The order in which sums and products are written back.
enum class Association {
  kPlain,    // left to right
  kShallow,  // what is ready first is combined first, so that the longest path is short
  kFused,    // the same with fused multiply-adds, in a chain where the longest path allows
};

Computation write_polynomials(const Polynomials& system, Association association);

}  // namespace sinew::program
