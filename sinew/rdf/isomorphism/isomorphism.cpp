#include "sinew/rdf/isomorphism/isomorphism.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <vector>

#include "sinew/rdf/isomorphism/refinement.h"

namespace sinew::rdf {
namespace {

using graph::Id;
using graph::Quad;

constexpr std::size_t kQuadsToShow = 5;

bool mentions_blank(const Quad& quad, const graph::Terms& terms) {
  return terms.is_blank(quad.subject) || terms.is_blank(quad.predicate) ||
         terms.is_blank(quad.object) || terms.is_blank(quad.graph);
}

std::string line(const Quad& quad, const graph::Terms& terms) {
  std::string text;
  for (const Id id : {quad.subject, quad.predicate, quad.object, quad.graph}) {
    if (id) text.append(terms.to_string(id)).append(" ");
  }
  return text += '.';
}

std::string list(const char* heading, std::span<const Quad> quads, const graph::Terms& terms) {
  if (quads.empty()) return {};
  std::string text = heading;
  for (const Quad& quad : quads.first(std::min(quads.size(), kQuadsToShow))) {
    text += fmt::format("\n  {}", line(quad, terms));
  }
  if (quads.size() > kQuadsToShow) {
    text += fmt::format("\n  and {} more", quads.size() - kQuadsToShow);
  }
  return text;
}

// The quads of one side, without repetitions: those of named terms only, and the others.
struct Side {
  std::vector<Quad> ground, blank;

  Side(std::span<const Quad> quads, const graph::Terms& terms) {
    std::vector<Quad> all(quads.begin(), quads.end());
    std::ranges::sort(all);
    all.erase(std::ranges::unique(all).begin(), all.end());
    for (const Quad& quad : all) (mentions_blank(quad, terms) ? blank : ground).push_back(quad);
  }
};

std::string ground_difference(const Side& left, const Side& right, const graph::Terms& terms) {
  std::vector<Quad> only_left, only_right;
  std::ranges::set_difference(left.ground, right.ground, std::back_inserter(only_left));
  std::ranges::set_difference(right.ground, left.ground, std::back_inserter(only_right));
  std::string text = list("only on the left:", only_left, terms);
  const std::string other = list("only on the right:", only_right, terms);
  if (!text.empty() && !other.empty()) text += '\n';
  return text + other;
}

// Tries to pair the blank nodes of two sides, which are parted into classes together: a class with
// a member of each side is a pair.
class Pairing {
 public:
  Pairing(std::span<const Quad> left, std::span<const Quad> right, const graph::Terms& terms,
          std::size_t budget)
      : left_(left),
        right_(right),
        structure_(left, right, terms),
        refiner_(structure_),
        budget_(budget) {}

  Likeness run() {
    Partition partition(static_cast<std::uint32_t>(structure_.size()));
    std::vector<std::uint32_t> all(structure_.size());
    std::iota(all.begin(), all.end(), 0);
    return search(std::move(partition), std::move(all));
  }

 private:
  bool is_left(std::uint32_t node) const { return node < structure_.left_size(); }

  Likeness search(Partition partition, std::vector<std::uint32_t> changed) {
    if (spent_ > budget_) return Likeness::kUndecided;
    spent_ += structure_.size();
    refiner_.refine(partition, std::move(changed));
    const auto choice = smallest_open_class(partition);
    if (!choice) return Likeness::kDifferent;
    if (*choice == partition.class_count()) {
      return agrees(partition) ? Likeness::kIsomorphic : Likeness::kDifferent;
    }
    // Whatever the true pairing is, this node has a partner among the others' members of its class.
    std::uint32_t chosen = 0;
    std::vector<std::uint32_t> partners;
    for (const std::uint32_t node : partition.members(*choice)) {
      if (is_left(node)) {
        chosen = node;
      } else {
        partners.push_back(node);
      }
    }
    for (const std::uint32_t partner : partners) {
      Partition next = partition;
      std::vector<std::uint32_t> pair = {chosen, partner};
      next.split(pair);
      const Likeness likeness = search(std::move(next), std::move(pair));
      if (likeness != Likeness::kDifferent) return likeness;
    }
    return Likeness::kDifferent;
  }

  // The smallest class of more than one pair; the number of classes if there is none; nothing if a
  // class has more members of one side than of the other, so that no pairing exists.
  std::optional<std::uint32_t> smallest_open_class(const Partition& partition) const {
    std::uint32_t best = partition.class_count();
    for (std::uint32_t cls = 0; cls < partition.class_count(); ++cls) {
      const auto members = partition.members(cls);
      const auto left = std::ranges::count_if(members, [&](auto node) { return is_left(node); });
      if (static_cast<std::size_t>(left) * 2 != members.size()) return std::nullopt;
      if (members.size() <= 2) continue;
      if (best == partition.class_count() || members.size() < partition.length[best]) best = cls;
    }
    return best;
  }

  // The pairs, put to the proof: hashes led to them.
  bool agrees(const Partition& partition) const {
    std::unordered_map<Id, Id> partner;
    for (std::uint32_t cls = 0; cls < partition.class_count(); ++cls) {
      const auto members = partition.members(cls);
      if (members.empty()) continue;
      const std::uint32_t left = is_left(members[0]) ? members[0] : members[1];
      const std::uint32_t right = is_left(members[0]) ? members[1] : members[0];
      partner[structure_.node(left)] = structure_.node(right);
    }
    const auto image = [&](Id id) {
      const auto found = partner.find(id);
      return found == partner.end() ? id : found->second;
    };
    std::vector<Quad> mapped;
    mapped.reserve(left_.size());
    for (const Quad& quad : left_) {
      mapped.push_back(
          {image(quad.subject), image(quad.predicate), image(quad.object), image(quad.graph)});
    }
    std::ranges::sort(mapped);
    return std::ranges::equal(mapped, right_);
  }

  std::span<const Quad> left_, right_;  // sorted
  BlankStructure structure_;
  Refiner refiner_;
  std::size_t budget_;
  std::size_t spent_ = 0;
};

}  // namespace

Comparison compare_quads(std::span<const Quad> left_quads, std::span<const Quad> right_quads,
                         const graph::Terms& terms, std::size_t budget) {
  const Side left(left_quads, terms), right(right_quads, terms);
  if (left.ground != right.ground) {
    return {Likeness::kDifferent, ground_difference(left, right, terms)};
  }
  if (left.blank.size() != right.blank.size()) {
    return {
        Likeness::kDifferent,
        fmt::format("{} quads with blank nodes on the left, {} on the right\n{}\n{}",
                    left.blank.size(), right.blank.size(), list("on the left:", left.blank, terms),
                    list("on the right:", right.blank, terms))};
  }
  if (left.blank == right.blank) return {Likeness::kIsomorphic, {}};
  Comparison result{Pairing(left.blank, right.blank, terms, budget).run(), {}};
  if (result.likeness == Likeness::kUndecided) {
    result.difference = "the blank nodes are too symmetric to be compared within the bound";
  } else if (result.likeness == Likeness::kDifferent) {
    result.difference = "the blank nodes cannot be paired\n" +
                        list("on the left:", left.blank, terms) + "\n" +
                        list("on the right:", right.blank, terms);
  }
  return result;
}

}  // namespace sinew::rdf
