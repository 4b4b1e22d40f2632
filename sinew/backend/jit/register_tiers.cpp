#include "sinew/backend/jit/register_tiers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::backend {
namespace {

struct Choice {
  std::vector<std::pair<unsigned, unsigned>> tiers;
  double cost = 0;  // weight times tier
};

// One value after the other, each in the first tier that has a place for as long as it lives.
class Chooser {
 public:
  Chooser(const std::vector<Lifetime>& lifetimes, const std::vector<unsigned>& sizes)
      : lifetimes_(lifetimes), sizes_(sizes) {
    for (const Lifetime& lifetime : lifetimes) begins_.push_back(lifetime.begin);
    std::sort(begins_.begin(), begins_.end());
    begins_.erase(std::unique(begins_.begin(), begins_.end()), begins_.end());
  }

  // Those come first that have the largest weight / length^exponent.
  Choice choose(double exponent) const {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < lifetimes_.size(); ++i) {
      const Lifetime& of = lifetimes_[i];
      order.push_back({-(of.weight / std::pow(of.end - of.begin, exponent)), i});
    }
    std::sort(order.begin(), order.end());
    std::vector<std::vector<unsigned>> there(sizes_.size(),
                                             std::vector<unsigned>(begins_.size(), 0));
    Choice choice;
    for (const auto& [unused, i] : order) {
      const unsigned tier = place(lifetimes_[i], there);
      choice.tiers.push_back({lifetimes_[i].value, tier});
      choice.cost += static_cast<double>(lifetimes_[i].weight) * tier;
    }
    return choice;
  }

 private:
  // How many values there are can only grow where one begins.
  std::ptrdiff_t point(unsigned at) const {
    return std::lower_bound(begins_.begin(), begins_.end(), at) - begins_.begin();
  }

  unsigned place(const Lifetime& lifetime, std::vector<std::vector<unsigned>>& there) const {
    const std::ptrdiff_t begin = point(lifetime.begin), end = point(lifetime.end);
    unsigned tier = 0;
    const auto is_full = [&](unsigned count) { return count >= sizes_[tier]; };
    while (tier + 1 < sizes_.size() &&
           std::any_of(there[tier].begin() + begin, there[tier].begin() + end, is_full)) {
      ++tier;
    }
    for (std::ptrdiff_t at = begin; at < end; ++at) ++there[tier][at];
    return tier;
  }

  const std::vector<Lifetime>& lifetimes_;
  const std::vector<unsigned>& sizes_;
  std::vector<unsigned> begins_;  // in order, each once
};

}  // namespace

std::vector<std::pair<unsigned, unsigned>> choose_tiers(const std::vector<Lifetime>& lifetimes,
                                                        const std::vector<unsigned>& sizes) {
  const Chooser chooser(lifetimes, sizes);
  Choice best;
  best.cost = std::numeric_limits<double>::infinity();
  for (const double exponent : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    Choice choice = chooser.choose(exponent);
    if (choice.cost < best.cost) best = std::move(choice);
  }
  return best.tiers;
}

}  // namespace sinew::backend
