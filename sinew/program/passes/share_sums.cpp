#include "sinew/program/passes/share_sums.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>
#include <unordered_map>

#include "sinew/program/passes/polynomials.h"
#include "sinew/program/passes/small_list.h"

namespace sinew::program {
namespace {

// Sums with more terms than this are left alone: the number of pairs grows with the square.
constexpr std::size_t kMaximumTerms = 40;

// Two terms up to a common sign. Lists of factors are numbered, so that pairs are compared quickly.
struct Pair {
  std::uint32_t first, second;     // numbers of lists; first's list comes before second's
  double first_size, second_size;  // of the coefficients
  bool opposite;                   // signs

  bool operator==(const Pair&) const = default;
};

std::uint64_t mixed(std::uint64_t h, std::uint64_t part) {
  h = (h ^ part) * 0x9e3779b97f4a7c15U;  // 2^64 / golden ratio
  return h ^ h >> 29U;
}

struct HashOfPair {
  std::size_t operator()(const Pair& pair) const {
    std::uint64_t h = mixed(pair.opposite ? 1 : 0, std::uint64_t{pair.first} << 32U | pair.second);
    h = mixed(h, std::bit_cast<std::uint64_t>(pair.first_size));
    return mixed(h, std::bit_cast<std::uint64_t>(pair.second_size));
  }
};

// Numbers the lists of factors that occur.
class FactorLists {
 public:
  std::uint32_t number(const Factors& factors) {
    const auto [known, fresh] =
        numbers_.try_emplace(factors, static_cast<std::uint32_t>(lists_.size()));
    if (fresh) lists_.push_back(&known->first);
    return known->second;
  }
  const Factors& operator[](std::uint32_t number) const { return *lists_[number]; }

 private:
  struct Hash {
    std::size_t operator()(const Factors& factors) const {
      std::uint64_t h = factors.size();
      for (const std::uint32_t factor : factors) h = mixed(h, factor);
      return h;
    }
  };
  std::unordered_map<Factors, std::uint32_t, Hash, std::equal_to<>,
                     Pooled<std::pair<const Factors, std::uint32_t>>>
      numbers_;
  std::vector<const Factors*> lists_;
};

class Sharing {
 public:
  explicit Sharing(Polynomials& system) : system_(system) {
    const std::vector<std::uint32_t> uses = use_counts(system);
    sums_.reserve(4 * uses.size());
    for (std::uint32_t i = 0; i < uses.size(); ++i) {
      if (uses[i] > 0 && system.is_polynomial[i]) enter(i);
    }
  }

  // Returns whether there was one.
  bool run() {
    bool changed = false;
    for (; !candidates_.empty(); changed = true) share(Pair(candidates_.begin()->entry->first));
    return changed;
  }

 private:
  using Numbers = SmallList<std::uint32_t, 2>;
  using Sums = std::unordered_map<Pair, Numbers, HashOfPair, std::equal_to<>,
                                  Pooled<std::pair<const Pair, Numbers>>>;
  // A pair that several sums contain. The one in most of them comes first; the smallest if there
  // are several.
  struct Candidate {
    const Sums::value_type* entry;
    std::size_t count;
  };
  struct Before {
    const FactorLists* lists;
    bool operator()(const Candidate& a, const Candidate& b) const {
      if (a.count != b.count) return a.count > b.count;
      const Pair &x = a.entry->first, &y = b.entry->first;
      if (x.first != y.first) return (*lists)[x.first] < (*lists)[y.first];
      if (x.second != y.second) return (*lists)[x.second] < (*lists)[y.second];
      return std::tie(x.first_size, x.second_size, x.opposite) <
             std::tie(y.first_size, y.second_size, y.opposite);
    }
  };

  struct Term {
    std::uint32_t list;
    double coefficient;
  };
  Pair pair_of(const Term& a, const Term& b) const {
    const bool in_order = a.list != b.list && lists_[a.list] < lists_[b.list];
    const Term& x = in_order ? a : b;
    const Term& y = in_order ? b : a;
    return {x.list, y.list, std::abs(x.coefficient), std::abs(y.coefficient),
            (x.coefficient < 0.0) != (y.coefficient < 0.0)};
  }

  template <typename Change>
  void for_each_pair(std::uint32_t i, Change change) {
    const Monomials& terms = system_.polynomial[i].terms;
    if (terms.size() < 2 || terms.size() > kMaximumTerms) return;
    SmallList<Term, 8> numbered;
    for (const Monomial& term : terms)
      numbered.push_back({lists_.number(term.factors), term.coefficient});
    for (std::size_t a = 0; a < numbered.size(); ++a) {
      for (std::size_t b = a + 1; b < numbered.size(); ++b)
        change(pair_of(numbered[a], numbered[b]));
    }
  }

  void no_candidate(const Sums::value_type& entry) {
    if (entry.second.size() > 1) candidates_.erase({&entry, entry.second.size()});
  }
  void candidate(const Sums::value_type& entry) {
    if (entry.second.size() > 1) candidates_.insert({&entry, entry.second.size()});
  }

  void enter(std::uint32_t i) {
    for_each_pair(i, [&](const Pair& pair) {
      Sums::value_type& entry = *sums_.try_emplace(pair).first;
      auto& sums = entry.second;
      if (std::find(sums.begin(), sums.end(), i) != sums.end()) return;
      no_candidate(entry);
      sums.push_back(i);
      candidate(entry);
    });
  }

  void leave(std::uint32_t i) {
    for_each_pair(i, [&](const Pair& pair) {
      const auto entry = sums_.find(pair);
      if (entry == sums_.end()) return;
      auto& sums = entry->second;
      const auto at = std::find(sums.begin(), sums.end(), i);
      if (at == sums.end()) return;
      no_candidate(*entry);
      sums.erase(at);
      candidate(*entry);
    });
  }

  void share(const Pair& pair) {
    const auto sums = sums_.find(pair)->second;
    Polynomial common;
    common.origin = system_.polynomial[sums.front()].origin;
    common.terms = {{pair.first_size, lists_[pair.first]},
                    {pair.opposite ? -pair.second_size : pair.second_size, lists_[pair.second]}};
    const std::uint32_t shared = system_.add(std::move(common));
    for (const std::uint32_t i : sums) {
      leave(i);
      Monomials& terms = system_.polynomial[i].terms;
      double sign = 1.0;
      for (const std::uint32_t list : {pair.first, pair.second}) {
        const auto at = std::find_if(terms.begin(), terms.end(), [&](const Monomial& term) {
          return term.factors == lists_[list];
        });
        if (list == pair.first) sign = at->coefficient < 0.0 ? -1.0 : 1.0;
        terms.erase(at);
      }
      terms.push_back({sign, {shared}});
      enter(i);
    }
    // The pair itself is one sum now, and stays.
    enter(shared);
    const auto entry = sums_.find(pair);
    no_candidate(*entry);
    sums_.erase(entry);
  }

  Polynomials& system_;
  FactorLists lists_;
  Sums sums_;  // that contain each pair
  std::set<Candidate, Before, Pooled<Candidate>> candidates_{Before{&lists_}};
};

}  // namespace

Computation share_sums(Computation computation) {
  Polynomials system = read_polynomials(std::move(computation));
  if (!Sharing(system).run()) return std::move(system.graph);
  return write_polynomials(system, Association::kPlain);
}

}  // namespace sinew::program
