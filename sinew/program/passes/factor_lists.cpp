#include "sinew/program/passes/factor_lists.h"

#include <algorithm>
#include <bit>

namespace sinew::program {

FactorLists::FactorLists(const Polynomials& system)
    : system_(system),
      of_node_(system.sums.size(), kNone),
      table_(std::bit_ceil(2 * system.terms.size() + 1), kNone),
      of_term_(system.terms.size(), kNone) {}

void FactorLists::count(const Sum& sum) {
  for (std::uint32_t k = sum.first; k < sum.first + sum.count; ++k) {
    const Term& term = system_.terms[k];
    std::uint32_t& list =
        term.count == 1 ? of_node_[system_.factors[term.first]] : of_product(term);
    if (list == kNone) {
      list = size();
      lists_.push_back({term, 0});
    }
    of_term_[k] = list;
    ++lists_[list].sums;
  }
}

std::uint32_t& FactorLists::of_product(const Term& term) {
  std::uint64_t h = term.count;
  for (const std::uint32_t factor : system_.factors_of(term)) h = mixed(h, factor);
  const std::size_t mask = table_.size() - 1;
  std::size_t at = h & mask;
  while (table_[at] != kNone && !same_factors(system_, lists_[table_[at]].term, term)) {
    at = (at + 1) & mask;
  }
  return table_[at];
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
