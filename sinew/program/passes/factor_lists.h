// The products that occur in sums, whatever their coefficients, as numbers: terms of several sums
// are compared quickly.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/program/passes/polynomials.h"

namespace sinew::program {

inline std::uint64_t mixed(std::uint64_t h, std::uint64_t part) {
  h = (h ^ part) * 0x9e3779b97f4a7c15U;  // 2^64 / golden ratio
  return h ^ h >> 29U;
}

class FactorLists {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  explicit FactorLists(const Polynomials& system);

  // Numbers the terms of a sum.
  void count(const Sum& sum);
  // A list that is known not to have a number; every sum that has it is about to be changed.
  std::uint32_t add(const Term& term);

  std::uint32_t size() const { return static_cast<std::uint32_t>(lists_.size()); }
  // The list of the term at this place of Polynomials::terms.
  std::uint32_t of_term(std::uint32_t place) const { return of_term_[place]; }
  void set(std::uint32_t place, std::uint32_t list) {
    if (of_term_.size() <= place) of_term_.resize(place + 1, kNone);
    of_term_[place] = list;
  }
  // Whether several of the sums that were counted have it, or it was added.
  bool in_several(std::uint32_t list) const { return lists_[list].sums > 1; }
  // Some term with these factors.
  const Term& operator[](std::uint32_t list) const { return lists_[list].term; }
  // By their factors, as words by their letters.
  bool before(std::uint32_t a, std::uint32_t b) const;

 private:
  struct List {
    Term term;
    std::uint32_t sums;
  };

  // The number of a list that is no node alone, or the place for it.
  std::uint32_t& of_product(const Term& term);

  const Polynomials& system_;
  std::vector<List> lists_;
  std::vector<std::uint32_t> of_node_;  // of each node alone
  std::vector<std::uint32_t> table_;    // of the others, by open addressing; kNone is free
  std::vector<std::uint32_t> of_term_;
};

}  // namespace sinew::program
