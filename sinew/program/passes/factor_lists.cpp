#include "sinew/program/passes/factor_lists.h"

#include <algorithm>
#include <bit>

namespace sinew::program {

FactorLists::FactorLists(const Polynomials& system)
    : system_(system),
      table_(std::bit_ceil(2 * system.terms.size() + 1), 0),
      of_term_(system.terms.size(), kNone) {}

void FactorLists::count(const Sum& sum) {
  const std::size_t mask = table_.size() - 1;
  for (std::uint32_t k = sum.first; k < sum.first + sum.count; ++k) {
    const Term& term = system_.terms[k];
    std::uint64_t h = term.count;
    for (const std::uint32_t factor : system_.factors_of(term)) h = mixed(h, factor);
    std::size_t at = h & mask;
    while (table_[at] != 0 && !same_factors(system_, lists_[table_[at] - 1].term, term)) {
      at = (at + 1) & mask;
    }
    if (table_[at] == 0) {
      lists_.push_back({term, 0});
      table_[at] = static_cast<std::uint32_t>(lists_.size());
    }
    of_term_[k] = table_[at] - 1;
    ++lists_[of_term_[k]].sums;
  }
}

std::uint32_t FactorLists::add(const Term& term) {
  lists_.push_back({term, 2});
  return static_cast<std::uint32_t>(lists_.size() - 1);
}

bool FactorLists::before(std::uint32_t a, std::uint32_t b) const {
  const auto x = system_.factors_of(lists_[a].term);
  const auto y = system_.factors_of(lists_[b].term);
  return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end());
}

}  // namespace sinew::program
