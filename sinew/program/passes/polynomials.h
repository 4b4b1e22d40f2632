// A graph seen as polynomials: additions and multiplications whose results nobody else uses are
// taken up into the sums that they are part of, whatever the order in which they were written. The
// passes that rearrange sums work on this form; writing it back makes additions and multiplications
// again.
//
// A graph of ten thousand nodes is read and written a dozen times. So the terms of all sums lie in
// one array and the factors of all terms in another; sums that a pass makes are appended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sinew/program/dag/dag.h"
#include "sinew/program/passes/pooled.h"

namespace sinew::program {

// coefficient * product of factors; the factors are numbers of nodes, sorted, repeated for powers.
// Without factors it is a constant.
struct Term {
  double coefficient;
  std::uint32_t first, count;  // in Polynomials::factors
};

struct Sum {
  std::uint32_t first = 0, count = 0;  // in Polynomials::terms
  std::uint32_t origin = kNoOrigin;
};

// The order in which sums and products are written back.
enum class Association {
  kPlain,    // left to right
  kShallow,  // what is ready first is combined first, so that the longest path is short
  kFused,    // the same with fused multiply-adds, in a chain where the longest path allows
};

enum class SumKind : std::uint8_t {
  kNone,     // the operation that it was
  kSum,      // of nodes that were there
  kOfAdded,  // perhaps of sums that passes have added
};

// Node i is what node i of the graph was, either a sum of terms or the operation that it was; the
// nodes behind those of the graph are sums that passes have added.
struct Polynomials {
  Computation graph;
  std::vector<SumKind> kinds;        // of each node
  std::vector<Sum> sums;             // of each node; empty where it is none, or has been taken up
  std::vector<std::uint32_t> nodes;  // those that are not part of another one, in their order
  std::vector<std::uint32_t> long_sums;  // of those the sums that were of several terms when read
  UnsetVector<Term> terms;               // of all sums: no two have one in common
  UnsetVector<std::uint32_t> factors;    // of all terms; after reading no two have one in common
  // How often each node is a factor of a live sum, an operand of another live operation, or a
  // result; 0 for a dead one. Passes keep it up to date.
  std::vector<std::uint32_t> uses;

  explicit Polynomials(Computation computation) : graph(std::move(computation)) {}

  // Every pass begins with it. Does nothing if the graph has been read since it was written.
  void read();
  // Additions and multiplications of the graph, which is read.
  std::uint32_t operations() {
    read();
    return operations_;
  }
  // Makes the graph anew. Precondition: it has been read.
  void write(Association association);

  std::span<Term> terms_of(std::uint32_t node) {
    return {terms.data() + sums[node].first, sums[node].count};
  }
  std::span<const Term> terms_of(std::uint32_t node) const {
    return {terms.data() + sums[node].first, sums[node].count};
  }
  std::span<const std::uint32_t> factors_of(const Term& term) const {
    return {factors.data() + term.first, term.count};
  }
  // A term whose factors are new; they have to be sorted.
  Term term(double coefficient, std::span<const std::uint32_t> of);
  // A new node for the terms from `first` on, which are the last ones. Nobody uses it yet, and what
  // its terms use is not counted.
  std::uint32_t add_sum(std::uint32_t first, std::uint32_t origin);
  // Adds terms of the same factors together and drops those that cancel, in the array of terms from
  // `first` to its end. Those before `distinct` are known to be different and not zero.
  void collect_last_terms(std::uint32_t first, std::uint32_t distinct);

  // Terms that a sum has from now on, or no longer: their factors are used so much more or less.
  // What nobody uses any more uses nothing itself.
  void retain(std::span<const Term> some);
  void release(std::span<const Term> some);
  void release(std::uint32_t node);

 private:
  friend class SumReader;

  bool is_read_ = false;
  std::uint32_t operations_ = 0;
};

inline bool same_factors(const Polynomials& system, const Term& a, const Term& b) {
  if (a.count != b.count) return false;
  for (std::uint32_t k = 0; k < a.count; ++k) {
    if (system.factors[a.first + k] != system.factors[b.first + k]) return false;
  }
  return true;
}

}  // namespace sinew::program
