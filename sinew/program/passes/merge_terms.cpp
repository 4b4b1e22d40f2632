#include "sinew/program/passes/merge_terms.h"

#include <algorithm>
#include <map>
#include <utility>

#include "sinew/program/passes/polynomials.h"

namespace sinew::program {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

// The two nodes of which a node is a linear combination, if it is one.
bool two_nodes(const Polynomials& system, std::uint32_t i, Pair& pair) {
  if (!system.is_polynomial[i]) return false;
  const Monomials& terms = system.polynomial[i].terms;
  if (terms.size() != 2 || terms[0].factors.size() != 1 || terms[1].factors.size() != 1) {
    return false;
  }
  pair = std::minmax(terms[0].factors[0], terms[1].factors[0]);
  return true;
}

class Merging {
 public:
  explicit Merging(Polynomials& system) : system_(system), uses_(use_counts(system)) {}

  // Returns whether terms met.
  bool run(std::uint32_t i) {
    // Linear terms by the two nodes that they combine.
    std::map<Pair, std::vector<std::size_t>> groups;
    std::vector<bool> expand(system_.polynomial[i].terms.size(), false);
    const Monomials& terms = system_.polynomial[i].terms;
    for (std::size_t k = 0; k < terms.size(); ++k) {
      Pair pair;
      if (terms[k].factors.size() == 1 && two_nodes(system_, terms[k].factors[0], pair)) {
        groups[pair].push_back(k);
      }
    }
    for (const auto& [pair, members] : groups) {
      // Terms that are one of the two nodes itself will meet as well.
      std::size_t meeting = 0;
      for (const Monomial& term : terms) {
        if (term.factors.size() == 1 &&
            (term.factors[0] == pair.first || term.factors[0] == pair.second)) {
          ++meeting;
        }
      }
      std::size_t freed = 0;  // additions that nobody else uses
      for (const std::size_t k : members) freed += uses_[terms[k].factors[0]] == 1 ? 1 : 0;
      // Before: one addition for each member and each meeting term; after: one for each node.
      if (members.size() + meeting + freed <= 2) continue;
      for (const std::size_t k : members) expand[k] = true;
    }
    if (std::none_of(expand.begin(), expand.end(), [](bool e) { return e; })) return false;

    Polynomial result;
    result.origin = system_.polynomial[i].origin;
    for (std::size_t k = 0; k < expand.size(); ++k) {
      if (!expand[k]) {
        result.terms.push_back(terms[k]);
        continue;
      }
      const std::uint32_t inner = terms[k].factors[0];
      for (Monomial term : system_.polynomial[inner].terms) {
        term.coefficient *= terms[k].coefficient;
        result.terms.push_back(std::move(term));
      }
    }
    collect_terms(result);
    system_.polynomial[i] = std::move(result);
    uses_ = use_counts(system_);
    return true;
  }

 private:
  Polynomials& system_;
  std::vector<std::uint32_t> uses_;
};

}  // namespace

Computation merge_terms(Computation computation) {
  Polynomials system = read_polynomials(std::move(computation));
  Merging merging(system);
  bool changed = false;
  for (std::uint32_t i = 0; i < system.polynomial.size(); ++i) {
    if (system.is_polynomial[i] && system.polynomial[i].terms.size() > 1) changed |= merging.run(i);
  }
  if (!changed) return std::move(system.graph);
  return write_polynomials(system, Association::kPlain);
}

}  // namespace sinew::program
