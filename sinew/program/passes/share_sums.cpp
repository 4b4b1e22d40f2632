#include "sinew/program/passes/share_sums.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <tuple>
#include <unordered_map>

#include "sinew/program/passes/polynomials.h"
#include "sinew/program/passes/small_list.h"

namespace sinew::program {
namespace {

// Sums with more terms than this are left alone: the number of pairs grows with the square.
constexpr std::size_t kMaximumTerms = 40;

// Two terms up to a common sign.
struct Pair {
  Factors first, second;           // first < second
  double first_size, second_size;  // of the coefficients
  bool opposite;                   // signs

  auto key() const { return std::tie(first, second, first_size, second_size, opposite); }
  bool operator<(const Pair& other) const { return key() < other.key(); }
  bool operator==(const Pair& other) const { return key() == other.key(); }
};

struct HashOfPair {
  std::size_t operator()(const Pair& pair) const {
    std::size_t h = pair.opposite ? 1 : 0;
    const auto mix = [&h](std::uint64_t part) {
      h = (h ^ part) * 0x9e3779b97f4a7c15U;  // 2^64 / golden ratio
      h ^= h >> 29U;
    };
    for (const std::uint32_t factor : pair.first) mix(factor);
    for (const std::uint32_t factor : pair.second) mix(std::uint64_t{factor} << 32U);
    mix(std::bit_cast<std::uint64_t>(pair.first_size));
    mix(std::bit_cast<std::uint64_t>(pair.second_size));
    return h;
  }
};

Pair pair_of(const Monomial& a, const Monomial& b) {
  const bool in_order = a.factors < b.factors;
  const Monomial& x = in_order ? a : b;
  const Monomial& y = in_order ? b : a;
  return {x.factors, y.factors, std::abs(x.coefficient), std::abs(y.coefficient),
          (x.coefficient < 0.0) != (y.coefficient < 0.0)};
}

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
  using Sums = std::unordered_map<Pair, SmallList<std::uint32_t, 2>, HashOfPair>;
  // A pair that several sums contain. The one in most of them comes first; the smallest if there
  // are several.
  struct Candidate {
    const Sums::value_type* entry;
    std::size_t count;
    bool operator<(const Candidate& other) const {
      if (count != other.count) return count > other.count;
      return entry->first < other.entry->first;
    }
  };

  template <typename Change>
  void for_each_pair(std::uint32_t i, Change change) {
    const std::vector<Monomial>& terms = system_.polynomial[i].terms;
    if (terms.size() < 2 || terms.size() > kMaximumTerms) return;
    for (std::size_t a = 0; a < terms.size(); ++a) {
      for (std::size_t b = a + 1; b < terms.size(); ++b) change(pair_of(terms[a], terms[b]));
    }
  }

  void no_candidate(const Sums::value_type& entry) {
    if (entry.second.size() > 1) candidates_.erase({&entry, entry.second.size()});
  }
  void candidate(const Sums::value_type& entry) {
    if (entry.second.size() > 1) candidates_.insert({&entry, entry.second.size()});
  }

  void enter(std::uint32_t i) {
    for_each_pair(i, [&](Pair pair) {
      Sums::value_type& entry = *sums_.try_emplace(std::move(pair)).first;
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
    common.terms = {{pair.first_size, pair.first},
                    {pair.opposite ? -pair.second_size : pair.second_size, pair.second}};
    const std::uint32_t shared = system_.add(std::move(common));
    for (const std::uint32_t i : sums) {
      leave(i);
      std::vector<Monomial>& terms = system_.polynomial[i].terms;
      double sign = 1.0;
      for (const auto* factors : {&pair.first, &pair.second}) {
        const auto at = std::find_if(terms.begin(), terms.end(), [&](const Monomial& term) {
          return term.factors == *factors;
        });
        if (factors == &pair.first) sign = at->coefficient < 0.0 ? -1.0 : 1.0;
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
  Sums sums_;  // that contain each pair
  std::set<Candidate> candidates_;
};

}  // namespace

Computation share_sums(Computation computation) {
  Polynomials system = read_polynomials(std::move(computation));
  if (!Sharing(system).run()) return std::move(system.graph);
  return write_polynomials(system, Association::kPlain);
}

}  // namespace sinew::program
