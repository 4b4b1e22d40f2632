#include "sinew/program/passes/share_sums.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "sinew/program/passes/polynomials.h"

namespace sinew::program {
namespace {

// Sums with more terms than this are left alone: the number of pairs grows with the square.
constexpr std::size_t kMaximumTerms = 40;

// Two terms up to a common sign.
struct Pair {
  std::vector<std::uint32_t> first, second;  // factors, first < second
  double first_size, second_size;            // of the coefficients
  bool opposite;                             // signs

  auto key() const { return std::tie(first, second, first_size, second_size, opposite); }
  bool operator<(const Pair& other) const { return key() < other.key(); }
};

Pair pair_of(const Monomial& a, const Monomial& b) {
  const Monomial& x = a.factors < b.factors ? a : b;
  const Monomial& y = a.factors < b.factors ? b : a;
  return {x.factors, y.factors, std::abs(x.coefficient), std::abs(y.coefficient),
          (x.coefficient < 0.0) != (y.coefficient < 0.0)};
}

class Sharing {
 public:
  explicit Sharing(Polynomials& system) : system_(system) {
    const std::vector<std::uint32_t> uses = use_counts(system);
    for (std::uint32_t i = 0; i < uses.size(); ++i) {
      if (uses[i] > 0 && system.is_polynomial[i]) enter(i);
    }
  }

  void run() {
    for (;;) {
      // The pair in most sums; the smallest of them if there are several.
      const Pair* best = nullptr;
      std::size_t best_count = 1;
      for (const auto& [pair, sums] : sums_) {
        if (sums.size() > best_count) {
          best = &pair;
          best_count = sums.size();
        }
      }
      if (best == nullptr) return;
      share(Pair(*best));
    }
  }

 private:
  template <typename Change>
  void for_each_pair(std::uint32_t i, Change change) {
    const std::vector<Monomial>& terms = system_.polynomial[i].terms;
    if (terms.size() < 2 || terms.size() > kMaximumTerms) return;
    for (std::size_t a = 0; a < terms.size(); ++a) {
      for (std::size_t b = a + 1; b < terms.size(); ++b) change(pair_of(terms[a], terms[b]));
    }
  }

  void enter(std::uint32_t i) {
    for_each_pair(i, [&](Pair pair) {
      std::vector<std::uint32_t>& sums = sums_[std::move(pair)];
      if (std::find(sums.begin(), sums.end(), i) == sums.end()) sums.push_back(i);
    });
  }

  void leave(std::uint32_t i) {
    for_each_pair(i, [&](const Pair& pair) {
      const auto at = sums_.find(pair);
      if (at == sums_.end()) return;
      std::erase(at->second, i);
      if (at->second.empty()) sums_.erase(at);
    });
  }

  void share(const Pair& pair) {
    const std::vector<std::uint32_t> sums = sums_[pair];
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
    enter(shared);
    // The pair itself is one sum now, and stays.
    sums_.erase(pair);
  }

  Polynomials& system_;
  std::map<Pair, std::vector<std::uint32_t>> sums_;  // that contain each pair
};

}  // namespace

Computation share_sums(Computation computation) {
  Polynomials system = read_polynomials(std::move(computation));
  Sharing(system).run();
  return write_polynomials(system, Association::kPlain);
}

}  // namespace sinew::program
