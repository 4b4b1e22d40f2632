#include "sinew/program/passes/factor_sums.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "sinew/program/passes/small_list.h"

namespace sinew::program {
namespace {

// A factor of a term as one number: a node, or behind all nodes the size of its coefficient (whose
// bits are in the order of the values).
using Factor = std::uint64_t;
constexpr Factor kConstant = Factor{1} << 63U;

bool is_scaled(const Term& term) { return std::abs(term.coefficient) != 1.0; }

Factor size_of(const Term& term) {
  return kConstant | std::bit_cast<std::uint64_t>(std::abs(term.coefficient));
}

// Whether a term has a factor that may be taken out: at least one other has to stay.
bool is_product(const Term& term) { return term.count + (is_scaled(term) ? 1U : 0U) >= 2; }

class Factoring {
 public:
  explicit Factoring(Polynomials& system) : system_(system) {}

  // Takes out the factor that most terms share, again and again. New sums are appended to the
  // system and looked at in their turn.
  void run(std::uint32_t i) {
    for (Factor best = 0; find_most_shared(i, best);) take_out(best, i);
  }

 private:
  // The smallest of those that occur most often, if one occurs twice.
  bool find_most_shared(std::uint32_t i, Factor& best) {
    all_.clear();
    // Mostly no factor occurs twice, which a set of 64 bits shows: each factor is one of them.
    std::uint64_t seen = 0;
    bool repeated = false;
    const auto add = [&](Factor factor) {
      const std::uint64_t bit = std::uint64_t{1} << (factor * 0x9e3779b97f4a7c15U >> 58U);
      repeated = repeated || (seen & bit) != 0;
      seen |= bit;
      all_.push_back(factor);
    };
    for (const Term& term : system_.terms_of(i)) {
      if (!is_product(term)) continue;
      const auto factors = system_.factors_of(term);
      for (std::size_t k = 0; k < factors.size(); ++k) {
        if (k == 0 || factors[k] != factors[k - 1]) add(factors[k]);
      }
      if (is_scaled(term)) add(size_of(term));
    }
    if (!repeated) return false;
    std::sort(all_.begin(), all_.end());
    std::size_t best_count = 1;
    for (std::size_t from = 0; from < all_.size();) {
      std::size_t to = from;
      while (to < all_.size() && all_[to] == all_[from]) ++to;
      if (to - from > best_count) {
        best = all_[from];
        best_count = to - from;
      }
      from = to;
    }
    return best_count > 1;
  }

  bool take_out(Factor factor, Term& term) {
    if (!is_product(term)) return false;
    if ((factor & kConstant) != 0) {
      if (!is_scaled(term) || size_of(term) != factor) return false;
      term.coefficient = term.coefficient < 0.0 ? -1.0 : 1.0;
      return true;
    }
    const auto first = system_.factors.begin() + term.first;
    const auto last = first + term.count;
    const auto at = std::find(first, last, static_cast<std::uint32_t>(factor));
    if (at == last) return false;
    std::copy(at + 1, last, at);
    --term.count;
    return true;
  }

  void take_out(Factor factor, std::uint32_t i) {
    const auto first = static_cast<std::uint32_t>(system_.terms.size());
    const Sum old = system_.sums[i];
    std::uint32_t outside = old.first;  // the next place for a term that stays
    for (std::uint32_t k = old.first; k < old.first + old.count; ++k) {
      Term term = system_.terms[k];
      if (take_out(factor, term)) {
        system_.terms.push_back(term);
      } else {
        system_.terms[outside++] = term;
      }
    }
    taken_out_.assign(system_.terms.begin() + first, system_.terms.end());
    system_.collect_last_terms(first, first);
    const std::uint32_t sum = system_.add_sum(first, old.origin);
    system_.kinds[i] = SumKind::kOfAdded;
    if (system_.uses[i] > 0) {
      system_.uses[sum] = 1;
      system_.retain(system_.terms_of(sum));
      system_.release(taken_out_);
      if ((factor & kConstant) == 0) {
        system_.uses[factor] -= static_cast<std::uint32_t>(taken_out_.size()) - 1;
      }
    }
    if ((factor & kConstant) != 0) {
      const double value = std::bit_cast<double>(factor & ~kConstant);
      system_.terms[outside++] = system_.term(value, {&sum, 1});
    } else {
      // The new sum has the largest number.
      const std::uint32_t factors[] = {static_cast<std::uint32_t>(factor), sum};
      system_.terms[outside++] = system_.term(1.0, factors);
    }
    system_.sums[i].count = outside - old.first;
  }

  Polynomials& system_;
  SmallList<Factor, 64> all_;  // of the sum that is looked at
  std::vector<Term> taken_out_;
};

}  // namespace

void factor_sums(Polynomials& system) {
  system.read();
  Factoring factoring(system);
  for (std::size_t k = 0; k < system.long_sums.size(); ++k) {
    const std::uint32_t i = system.long_sums[k];
    if (system.sums[i].count > 1) factoring.run(i);
  }
  // Also where nothing was taken out: products are in the order of their factors afterwards.
  system.write(Association::kPlain);
}

}  // namespace sinew::program
