// Registers come in tiers, and the names of the first are shorter: which value should get one of
// which tier.
#pragma once

#include <utility>
#include <vector>

namespace sinew::backend {

struct Lifetime {
  unsigned value;
  unsigned begin, end;  // in any unit; the end is past the last
  unsigned weight;      // what it would cost to have a longer name
};

// Each value and its tier, such that never more than `sizes[tier]` values are in one; what finds no
// place in any is in the last. What weighs most, altogether or for as long as it lives, comes
// first: whichever leaves less weight to the later tiers.
std::vector<std::pair<unsigned, unsigned>> choose_tiers(const std::vector<Lifetime>& lifetimes,
                                                        const std::vector<unsigned>& sizes);

}  // namespace sinew::backend
