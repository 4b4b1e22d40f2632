#include "sinew/program/passes/share_sums.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>
#include <unordered_map>

#include "sinew/program/passes/factor_lists.h"
#include "sinew/program/passes/small_list.h"

namespace sinew::program {
namespace {

// Sums with more terms than this are left alone: the number of pairs grows with the square.
constexpr std::size_t kMaximumTerms = 40;
constexpr std::size_t kFewestSightings = 256, kMostSightings = 1U << 20U;  // bytes

// Two terms up to a common sign. Lists of factors are numbered, so that pairs are compared quickly.
struct Pair {
  std::uint32_t first, second;     // numbers of lists; first's list comes before second's
  double first_size, second_size;  // of the coefficients
  bool opposite;                   // signs

  bool operator==(const Pair&) const = default;
};

struct HashOfPair {
  std::size_t operator()(const Pair& pair) const {
    std::uint64_t h = mixed(pair.opposite ? 1 : 0, std::uint64_t{pair.first} << 32U | pair.second);
    h = mixed(h, std::bit_cast<std::uint64_t>(pair.first_size));
    return mixed(h, std::bit_cast<std::uint64_t>(pair.second_size));
  }
};

class Sharing {
 public:
  explicit Sharing(Polynomials& system) : system_(system), lists_(system) {
    std::size_t pairs = 0;
    for (const std::uint32_t i : system.long_sums) {
      if (!has_pairs(i)) continue;
      lists_.count(system.sums[i]);
      pairs += std::size_t{system.sums[i].count} * (system.sums[i].count - 1) / 2;
    }
    first_added_ = lists_.size();
    sightings_.assign(std::bit_ceil(std::clamp(2 * pairs, kFewestSightings, kMostSightings)), 0);
    if (!sight()) return;
    for (std::size_t k = 0; k < several_.size(); ++k) enter(several_[k].sum, terms_of(k));
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
      if (x.first != y.first) return lists->before(x.first, y.first);
      if (x.second != y.second) return lists->before(x.second, y.second);
      return std::tie(x.first_size, x.second_size, x.opposite) <
             std::tie(y.first_size, y.second_size, y.opposite);
    }
  };

  struct Numbered {
    std::uint32_t list;
    double coefficient;
    std::uint64_t hash;  // of the list and the size of the coefficient
  };
  Pair pair_of(const Numbered& a, const Numbered& b) const {
    const bool in_order = lists_.before(a.list, b.list);
    const Numbered& x = in_order ? a : b;
    const Numbered& y = in_order ? b : a;
    return {x.list, y.list, std::abs(x.coefficient), std::abs(y.coefficient),
            (x.coefficient < 0.0) != (y.coefficient < 0.0)};
  }

  bool has_pairs(std::uint32_t i) const {
    return system_.sums[i].count >= 2 && system_.sums[i].count <= kMaximumTerms;
  }

  // Appends the terms of a sum whose lists others have as well.
  void append_numbered(std::uint32_t i, std::vector<Numbered>& to) const {
    const Sum& sum = system_.sums[i];
    for (std::uint32_t k = sum.first; k < sum.first + sum.count; ++k) {
      const std::uint32_t list = lists_.of_term(k);
      if (!lists_.in_several(list)) continue;
      const double coefficient = system_.terms[k].coefficient;
      const std::uint64_t size = std::bit_cast<std::uint64_t>(std::abs(coefficient));
      to.push_back({list, coefficient, mixed(list, size)});
    }
  }
  std::span<const Numbered> numbered(std::uint32_t i) {
    numbered_.clear();
    if (has_pairs(i)) append_numbered(i, numbered_);
    return numbered_;
  }
  // Of a sum of several_.
  std::span<const Numbered> terms_of(std::size_t k) const {
    const std::size_t from = several_[k].first;
    const std::size_t to = k + 1 < several_.size() ? several_[k + 1].first : all_.size();
    return {all_.data() + from, to - from};
  }

  // Most pairs occur once. Counting them by a hash alone shows which those are, and they need not
  // be entered: only lists that sharing adds make new pairs, the others become fewer.
  std::uint8_t& sightings(const Numbered& a, const Numbered& b) {
    const bool opposite = (a.coefficient < 0.0) != (b.coefficient < 0.0);
    const std::uint64_t hash = mixed(a.hash + b.hash, opposite ? 1 : 0);
    return sightings_[hash & (sightings_.size() - 1)];
  }
  bool occurs_once(const Numbered& a, const Numbered& b) {
    return a.list < first_added_ && b.list < first_added_ && sightings(a, b) < 2;
  }
  // Counts the pairs of all sums. Returns whether one may have occurred twice.
  bool sight() {
    bool again = false;
    for (const std::uint32_t i : system_.long_sums) {
      if (!has_pairs(i)) continue;
      const std::size_t first = all_.size();
      append_numbered(i, all_);
      if (all_.size() < first + 2) {
        all_.resize(first);
        continue;
      }
      several_.push_back({i, first});
      for (std::size_t a = first; a < all_.size(); ++a) {
        for (std::size_t b = a + 1; b < all_.size(); ++b) {
          std::uint8_t& count = sightings(all_[a], all_[b]);
          again |= count > 0;
          count = count > 0 ? 2 : 1;
        }
      }
    }
    return again;
  }

  // Of those that several sums might have in common.
  template <typename Change>
  void for_each_pair(std::span<const Numbered> terms, Change change) {
    for (std::size_t a = 0; a < terms.size(); ++a) {
      for (std::size_t b = a + 1; b < terms.size(); ++b) {
        if (!occurs_once(terms[a], terms[b])) change(pair_of(terms[a], terms[b]));
      }
    }
  }

  void no_candidate(const Sums::value_type& entry) {
    if (entry.second.size() > 1) candidates_.erase({&entry, entry.second.size()});
  }
  void candidate(const Sums::value_type& entry) {
    if (entry.second.size() > 1) candidates_.insert({&entry, entry.second.size()});
  }

  void enter(std::uint32_t i) { enter(i, numbered(i)); }
  void enter(std::uint32_t i, std::span<const Numbered> terms) {
    for_each_pair(terms, [&](const Pair& pair) {
      Sums::value_type& entry = *sums_.try_emplace(pair).first;
      auto& sums = entry.second;
      if (std::find(sums.begin(), sums.end(), i) != sums.end()) return;
      no_candidate(entry);
      sums.push_back(i);
      candidate(entry);
    });
  }

  void leave(std::uint32_t i) {
    for_each_pair(numbered(i), [&](const Pair& pair) {
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
    const auto first = static_cast<std::uint32_t>(system_.terms.size());
    append(pair.first, pair.first_size);
    append(pair.second, pair.opposite ? -pair.second_size : pair.second_size);
    const std::uint32_t shared = system_.add_sum(first, system_.sums[sums.front()].origin);
    count_uses(shared, sums);
    std::uint32_t shared_list = FactorLists::kNone;
    for (const std::uint32_t i : sums) {
      leave(i);
      const Sum sum = system_.sums[i];
      std::uint32_t to = sum.first;
      double sign = 1.0;
      for (std::uint32_t from = sum.first; from < sum.first + sum.count; ++from) {
        const std::uint32_t list = lists_.of_term(from);
        if (list == pair.first) sign = system_.terms[from].coefficient < 0.0 ? -1.0 : 1.0;
        if (list == pair.first || list == pair.second) continue;
        system_.terms[to] = system_.terms[from];
        lists_.set(to++, list);
      }
      system_.terms[to] = system_.term(sign, {&shared, 1});
      if (shared_list == FactorLists::kNone) shared_list = lists_.add(system_.terms[to]);
      lists_.set(to, shared_list);
      system_.sums[i].count = to + 1 - sum.first;
      system_.kinds[i] = SumKind::kOfAdded;
      enter(i);
    }
    // The pair itself is one sum now, and stays.
    enter(shared);
    const auto entry = sums_.find(pair);
    no_candidate(*entry);
    sums_.erase(entry);
  }

  // The live ones of these sums use the shared one from now on instead of its terms.
  void count_uses(std::uint32_t shared, const Numbers& sums) {
    const auto live = static_cast<std::uint32_t>(std::count_if(
        sums.begin(), sums.end(), [this](std::uint32_t i) { return system_.uses[i] > 0; }));
    if (live == 0) return;
    system_.uses[shared] = live;
    for (const Term& term : system_.terms_of(shared)) {
      for (const std::uint32_t factor : system_.factors_of(term)) system_.uses[factor] -= live - 1;
    }
  }

  void append(std::uint32_t list, double coefficient) {
    Term term = lists_[list];
    term.coefficient = coefficient;
    system_.terms.push_back(term);
    lists_.set(static_cast<std::uint32_t>(system_.terms.size()) - 1, list);
  }

  Polynomials& system_;
  FactorLists lists_;
  std::uint32_t first_added_ = 0;        // lists from here on were made by sharing
  std::vector<std::uint8_t> sightings_;  // of pairs, up to two, by their hashes
  // The terms of each sum that has several such, as they were before anything was shared.
  struct Several {
    std::uint32_t sum;
    std::size_t first;  // in all_
  };
  std::vector<Numbered> all_;
  std::vector<Several> several_;
  std::vector<Numbered> numbered_;  // the same of the sum that is looked at
  Sums sums_;                       // that contain each pair
  std::set<Candidate, Before, Pooled<Candidate>> candidates_{Before{&lists_}};
};

}  // namespace

void share_sums(Polynomials& system) {
  system.read();
  if (Sharing(system).run()) system.write(Association::kPlain);
}

}  // namespace sinew::program
