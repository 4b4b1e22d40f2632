#include "sinew/program/passes/factor_sums.h"

#include <algorithm>
#include <cmath>

#include "sinew/program/passes/polynomials.h"
#include "sinew/program/passes/small_list.h"

namespace sinew::program {
namespace {

// A factor of a term: a node, or the size of its coefficient.
struct Factor {
  bool constant = false;
  std::uint32_t node = 0;
  double value = 0.0;

  auto operator<=>(const Factor&) const = default;
};

using FactorList = SmallList<Factor, 16>;

// The factors that may be taken out of a term: at least one other has to stay.
FactorList factors_of(const Monomial& term) {
  FactorList factors;
  const bool scaled = std::abs(term.coefficient) != 1.0;
  if (term.factors.size() + (scaled ? 1 : 0) < 2) return factors;
  for (std::size_t k = 0; k < term.factors.size(); ++k) {
    if (k == 0 || term.factors[k] != term.factors[k - 1]) {
      factors.push_back({false, term.factors[k], 0.0});
    }
  }
  if (scaled) factors.push_back({true, 0, std::abs(term.coefficient)});
  return factors;
}

bool take_out(const Factor& factor, Monomial& term) {
  const FactorList factors = factors_of(term);
  if (std::find(factors.begin(), factors.end(), factor) == factors.end()) return false;
  if (factor.constant) {
    term.coefficient = term.coefficient < 0.0 ? -1.0 : 1.0;
  } else {
    term.factors.erase(std::find(term.factors.begin(), term.factors.end(), factor.node));
  }
  return true;
}

// Takes out the factor that most terms share, again and again. New sums are appended to the system
// and looked at in their turn.
void factor(Polynomials& system, std::uint32_t i) {
  for (;;) {
    Monomials& terms = system.polynomial[i].terms;
    FactorList all;
    for (const Monomial& term : terms) {
      const FactorList of_term = factors_of(term);
      all.append(of_term.begin(), of_term.end());
    }
    std::sort(all.begin(), all.end());
    // The smallest of those that occur most often.
    Factor best;
    std::size_t best_count = 1;
    for (std::size_t from = 0; from < all.size();) {
      std::size_t to = from;
      while (to < all.size() && all[to] == all[from]) ++to;
      if (to - from > best_count) {
        best = all[from];
        best_count = to - from;
      }
      from = to;
    }
    if (best_count < 2) return;

    Polynomial inside;
    inside.origin = system.polynomial[i].origin;
    Monomials outside;
    for (Monomial& term : terms) {
      (take_out(best, term) ? inside.terms : outside).push_back(std::move(term));
    }
    collect_terms(inside);
    const std::uint32_t sum = system.add(std::move(inside));
    Monomial product;
    product.factors = {sum};
    if (best.constant) {
      product.coefficient = best.value;
    } else {
      product.factors = {std::min(best.node, sum), std::max(best.node, sum)};
    }
    outside.push_back(std::move(product));
    system.polynomial[i].terms = std::move(outside);
  }
}

}  // namespace

Computation factor_sums(Computation computation) {
  Polynomials system = read_polynomials(std::move(computation));
  for (std::uint32_t i = 0; i < system.polynomial.size(); ++i) {
    if (system.is_polynomial[i] && system.polynomial[i].terms.size() > 1) factor(system, i);
  }
  return write_polynomials(system, Association::kPlain);
}

}  // namespace sinew::program
