#include "sinew/backend/jit/result_pairs.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

namespace sinew::backend {
namespace {

using program::LimbProgram;
using program::LimbRegion;
using program::LimbSource;
using program::Ref;

// Steps for which a value may wait in a register for its neighbour.
constexpr std::uint32_t kLongestWait = 32;
// Places of a pair of plain numbers.
constexpr std::size_t kFewestOfPlainNumbers = 2;

// A result that a node of a region is, with its own sign.
struct Origin {
  std::uint32_t region = 0, node = 0, lane = 0;
};

class Pairing {
 public:
  Pairing(const LimbProgram& program, const std::vector<std::vector<std::uint32_t>>& statements)
      : program_(program) {
    for (const std::vector<std::uint32_t>& of_region : statements) {
      std::map<std::uint32_t, std::uint32_t>& steps = steps_.emplace_back();
      for (const std::uint32_t node : of_region) {
        steps.emplace(node, static_cast<std::uint32_t>(steps.size()));
      }
    }
  }

  std::vector<ResultPair> run() const {
    std::vector<ResultPair> candidates = all_neighbours();
    // Those of most limbs first.
    std::stable_sort(
        candidates.begin(), candidates.end(),
        [](const ResultPair& a, const ResultPair& b) { return a.places.size() > b.places.size(); });
    std::vector<bool> taken(program_.results.size(), false);
    std::vector<ResultPair> chosen;
    for (ResultPair& pair : candidates) {
      std::erase_if(pair.places, [&](const ResultPair::Place& place) {
        return taken[place.left] || taken[place.left + 1];
      });
      if (program_.regions[pair.region].lanes == 1 && pair.places.size() < kFewestOfPlainNumbers) {
        continue;
      }
      for (const ResultPair::Place& place : pair.places) {
        taken[place.left] = taken[place.left + 1] = true;
      }
      if (!pair.places.empty()) chosen.push_back(std::move(pair));
    }
    return chosen;
  }

 private:
  std::optional<Origin> origin(std::uint32_t result) const {
    const LimbSource& source = program_.results[result];
    if (source.kind != LimbSource::Kind::kRegion) return std::nullopt;
    const Ref of = program_.regions[source.region].computation.results[source.index];
    if (source.negative != of.negative()) return std::nullopt;
    if (!steps_[source.region].contains(of.node())) return std::nullopt;
    return Origin{source.region, of.node(), source.lane};
  }

  // In the order of their first places.
  std::vector<ResultPair> all_neighbours() const {
    std::vector<ResultPair> pairs;
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::size_t> known;
    for (std::uint32_t i = 0; i + 1 < program_.results.size(); ++i) {
      const auto left = origin(i), right = origin(i + 1);
      if (!left || !right || left->region != right->region || left->lane != right->lane) continue;
      if (left->node == right->node) continue;
      const auto& steps = steps_[left->region];
      const std::uint32_t at_left = steps.at(left->node), at_right = steps.at(right->node);
      if (std::max(at_left, at_right) - std::min(at_left, at_right) > kLongestWait) continue;
      const auto [at, is_new] =
          known.emplace(std::tuple(left->region, left->node, right->node), pairs.size());
      if (is_new) {
        pairs.push_back({.region = left->region,
                         .left = left->node,
                         .right = right->node,
                         .later = at_left < at_right ? right->node : left->node,
                         .places = {}});
      }
      pairs[at->second].places.push_back({left->lane, i});
    }
    return pairs;
  }

  const LimbProgram& program_;
  std::vector<std::map<std::uint32_t, std::uint32_t>> steps_;  // [region]: of a node
};

}  // namespace

std::vector<ResultPair> pair_results(const LimbProgram& program,
                                     const std::vector<std::vector<std::uint32_t>>& statements) {
  return Pairing(program, statements).run();
}

}  // namespace sinew::backend
