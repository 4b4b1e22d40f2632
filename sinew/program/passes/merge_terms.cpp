#include "sinew/program/passes/merge_terms.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace sinew::program {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

class Merging {
 public:
  explicit Merging(Polynomials& system) : system_(system) {}

  // Returns whether terms met.
  bool run(std::uint32_t i) {
    find_expandable(i);
    bool changed = false;
    const std::span<const Term> terms = system_.terms_of(i);
    for (std::size_t from = 0; from < expandable_.size();) {
      std::size_t to = from;
      const Pair pair = expandable_[from].nodes;
      while (to < expandable_.size() && expandable_[to].nodes == pair) ++to;
      // Terms that are one of the two nodes itself will meet as well.
      const auto meets = [&](const Term& term) {
        if (term.count != 1) return false;
        const std::uint32_t node = system_.factors[term.first];
        return node == pair.first || node == pair.second;
      };
      const auto meeting =
          static_cast<std::size_t>(std::count_if(terms.begin(), terms.end(), meets));
      std::size_t freed = 0;  // additions that nobody else uses
      for (std::size_t k = from; k < to; ++k) {
        freed += system_.uses[system_.factors[terms[expandable_[k].term].first]] == 1 ? 1 : 0;
      }
      // Before: one addition for each member and each meeting term; after: one for each node.
      if (to - from + meeting + freed > 2) {
        for (std::size_t k = from; k < to; ++k) expandable_[k].expand = changed = true;
      }
      from = to;
    }
    if (changed) expand(i);
    return changed;
  }

 private:
  // A term that is a linear combination of two nodes.
  struct Expandable {
    Pair nodes;
    std::uint32_t term = 0;  // of the sum
    bool expand = false;
  };

  // Those of a sum, by the two nodes that they combine.
  void find_expandable(std::uint32_t i) {
    expandable_.clear();
    const std::span<const Term> terms = system_.terms_of(i);
    for (std::uint32_t k = 0; k < terms.size(); ++k) {
      if (terms[k].count != 1) continue;
      const std::uint32_t inner = system_.factors[terms[k].first];
      if (system_.sums[inner].count != 2) continue;
      const std::span<const Term> two = system_.terms_of(inner);
      if (two[0].count != 1 || two[1].count != 1) continue;
      const Pair nodes = std::minmax(system_.factors[two[0].first], system_.factors[two[1].first]);
      expandable_.push_back({nodes, k});
    }
    std::sort(expandable_.begin(), expandable_.end(),
              [](const Expandable& a, const Expandable& b) { return a.nodes < b.nodes; });
  }

  void expand(std::uint32_t i) {
    const Sum old = system_.sums[i];
    const auto first = static_cast<std::uint32_t>(system_.terms.size());
    for (std::uint32_t k = 0; k < old.count; ++k) {
      const Term outer = system_.terms[old.first + k];
      const bool expands =
          std::any_of(expandable_.begin(), expandable_.end(),
                      [&](const Expandable& e) { return e.expand && e.term == k; });
      if (!expands) {
        system_.terms.push_back(outer);
        continue;
      }
      const Sum inner = system_.sums[system_.factors[outer.first]];
      for (std::uint32_t j = 0; j < inner.count; ++j) {
        Term term = system_.terms[inner.first + j];
        term.coefficient *= outer.coefficient;
        system_.terms.push_back(term);
      }
    }
    system_.collect_last_terms(first, first);
    system_.sums[i] = {first, static_cast<std::uint32_t>(system_.terms.size()) - first, old.origin};
    // What the new terms use is in use already, by the sums that they come from.
    if (system_.uses[i] == 0) return;
    system_.retain(system_.terms_of(i));
    system_.release({system_.terms.data() + old.first, old.count});
  }

  Polynomials& system_;
  std::vector<Expandable> expandable_;  // of the sum that is looked at
};

}  // namespace

void merge_terms(Polynomials& system) {
  system.read();
  Merging merging(system);
  bool changed = false;
  for (const std::uint32_t i : system.long_sums) {
    if (system.sums[i].count > 1) changed |= merging.run(i);
  }
  if (changed) system.write(Association::kPlain);
}

}  // namespace sinew::program
