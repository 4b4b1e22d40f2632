#include "sinew/program/passes/polynomials.h"

#include <algorithm>

namespace sinew::program {

Term Polynomials::term(double coefficient, std::span<const std::uint32_t> of) {
  const Term result{coefficient, static_cast<std::uint32_t>(factors.size()),
                    static_cast<std::uint32_t>(of.size())};
  factors.insert(factors.end(), of.begin(), of.end());
  return result;
}

std::uint32_t Polynomials::add_sum(std::uint32_t first, std::uint32_t origin) {
  kinds.push_back(SumKind::kOfAdded);
  sums.push_back({first, static_cast<std::uint32_t>(terms.size()) - first, origin});
  uses.push_back(0);
  nodes.push_back(static_cast<std::uint32_t>(sums.size() - 1));
  long_sums.push_back(nodes.back());
  return static_cast<std::uint32_t>(sums.size() - 1);
}

void Polynomials::collect_last_terms(std::uint32_t first, std::uint32_t distinct) {
  // Mostly there is nothing to collect.
  const std::span<Term> all(terms.data() + first, terms.size() - first);
  bool done = true;
  for (std::size_t a = distinct - first; a < all.size() && done; ++a) {
    done = all[a].coefficient != 0.0;
    for (std::size_t b = 0; b < a && done; ++b) done = !same_factors(*this, all[a], all[b]);
  }
  if (done) return;
  std::size_t kept = 0;
  for (const Term& term : all) {
    const auto same = std::find_if(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept),
                                   [&](const Term& t) { return same_factors(*this, t, term); });
    if (same == all.begin() + static_cast<std::ptrdiff_t>(kept)) {
      all[kept++] = term;
    } else {
      same->coefficient = Dag::sum_of_constants(same->coefficient, term.coefficient);
    }
  }
  terms.resize(first + kept);
  terms.erase(std::remove_if(terms.begin() + first, terms.end(),
                             [](const Term& term) { return term.coefficient == 0.0; }),
              terms.end());
}

void Polynomials::retain(std::span<const Term> some) {
  for (const Term& term : some) {
    for (const std::uint32_t factor : factors_of(term)) ++uses[factor];
  }
}

void Polynomials::release(std::span<const Term> some) {
  for (const Term& term : some) {
    for (const std::uint32_t factor : factors_of(term)) release(factor);
  }
}

void Polynomials::release(std::uint32_t node) {
  if (--uses[node] > 0) return;
  // No recursion: what nobody uses any more may be as deep as a graph.
  std::vector<std::uint32_t> unused = {node};
  const auto drop = [&](std::uint32_t used) {
    if (--uses[used] == 0) unused.push_back(used);
  };
  while (!unused.empty()) {
    const std::uint32_t i = unused.back();
    unused.pop_back();
    if (kinds[i] != SumKind::kNone) {
      for (const Term& term : terms_of(i)) {
        for (const std::uint32_t factor : factors_of(term)) drop(factor);
      }
      continue;
    }
    const Node& operation = graph.dag.node(i);
    const Ref operands[] = {operation.a, operation.b, operation.c};
    for (int k = 0; k < arity(operation.op); ++k) drop(operands[k].node());
  }
}

}  // namespace sinew::program
