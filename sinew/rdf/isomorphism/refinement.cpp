#include "sinew/rdf/isomorphism/refinement.h"

#include <algorithm>
#include <numeric>
#include <string_view>

namespace sinew::rdf {
namespace {

using graph::Id;

// A bijective mixer of 64 bits (Steele, Lea, Flood, "Fast splittable pseudorandom number
// generators", 2014, the variant of Stafford).
constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ull;
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ x >> 27) * 0x94D049BB133111EBull;
  return x ^ x >> 31;
}

constexpr std::uint64_t combine(std::uint64_t seed, std::uint64_t value) {
  return mix(seed ^ mix(value));
}

// FNV-1a: the same on every machine and in every run, which std::hash does not promise.
constexpr std::uint64_t hash_text(std::string_view text) {
  std::uint64_t hash = 0xCBF29CE484222325ull;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
  return hash;
}

std::uint64_t hash_term(Id id, const graph::Terms& terms) {
  if (!id) return 0;
  std::uint64_t hash = combine(terms.is_literal(id) ? 1 : 2, hash_text(terms.text(id)));
  if (terms.is_literal(id)) {
    hash = combine(hash, hash_text(terms.text(terms.datatype(id))));
    hash = combine(hash, hash_text(terms.language(id)));
  }
  return hash;
}

std::array<Id, 4> fields_of(const graph::Quad& quad) {
  return {quad.subject, quad.predicate, quad.object, quad.graph};
}

// What a row says about the node in its field `own`.
std::uint64_t hash_row(const BlankStructure::Row& row, std::size_t own,
                       const Partition& partition) {
  std::uint64_t hash = mix(own);
  for (const BlankStructure::Field& field : row) {
    std::uint64_t value = field.value;
    if (field.is_blank) {
      const bool self = field.value == row[own].value;
      value = mix(partition.class_of[field.value]) + (self ? 1 : 2);
    }
    hash = combine(hash, value);
  }
  return hash;
}

}  // namespace

BlankStructure::BlankStructure(std::span<const graph::Quad> quads, const graph::Terms& terms)
    : BlankStructure(quads, {}, terms) {}

BlankStructure::BlankStructure(std::span<const graph::Quad> left,
                               std::span<const graph::Quad> right, const graph::Terms& terms) {
  add_rows(left, terms);
  left_size_ = nodes_.size();
  add_rows(right, terms);
  index_rows();
}

void BlankStructure::add_rows(std::span<const graph::Quad> quads, const graph::Terms& terms) {
  std::unordered_map<Id, Field> known;
  for (const graph::Quad& quad : quads) {
    const std::array<Id, 4> ids = fields_of(quad);
    if (std::ranges::none_of(ids, [&](Id id) { return terms.is_blank(id); })) continue;
    Row row;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto [entry, is_new] = known.try_emplace(ids[i]);
      if (is_new && terms.is_blank(ids[i])) {
        entry->second = {true, nodes_.size()};
        nodes_.push_back(ids[i]);
      } else if (is_new) {
        entry->second = {false, hash_term(ids[i], terms)};
      }
      row[i] = entry->second;
    }
    rows_.push_back(row);
  }
}

void BlankStructure::index_rows() {
  // The rows of each node, once each, as one flat array.
  const auto each_mention = [&](auto&& visit) {
    for (std::uint32_t row = 0; row < rows_.size(); ++row) {
      for (std::size_t i = 0; i < 4; ++i) {
        const Field field = rows_[row][i];
        if (!field.is_blank) continue;
        bool earlier = false;
        for (std::size_t k = 0; k < i; ++k) {
          earlier |= rows_[row][k].is_blank && rows_[row][k].value == field.value;
        }
        if (!earlier) visit(field.value, row);
      }
    }
  };
  first_.assign(nodes_.size() + 1, 0);
  each_mention([&](std::uint64_t node, std::uint32_t) { ++first_[node + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  incident_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  each_mention([&](std::uint64_t node, std::uint32_t row) { incident_[next[node]++] = row; });
}

Partition::Partition(std::uint32_t nodes)
    : order(nodes), position(nodes), class_of(nodes, 0), start(1, 0), length(1, nodes) {
  std::iota(order.begin(), order.end(), 0);
  std::iota(position.begin(), position.end(), 0);
}

std::uint32_t Partition::split(std::span<const std::uint32_t> nodes) {
  const std::uint32_t old = class_of[nodes.front()];
  const std::uint32_t fresh = class_count();
  std::uint32_t end = start[old] + length[old];
  for (const std::uint32_t node : nodes) {  // each changes places with the last that stays
    --end;
    const std::uint32_t other = order[end];
    std::swap(order[position[node]], order[end]);
    std::swap(position[node], position[other]);
    class_of[node] = fresh;
  }
  const auto count = static_cast<std::uint32_t>(nodes.size());
  length[old] -= count;
  start.push_back(end);
  length.push_back(count);
  return fresh;
}

Refiner::Refiner(const BlankStructure& structure)
    : structure_(structure),
      view_(structure.size(), 0),
      is_affected_(structure.size(), false),
      row_done_(structure.rows().size(), false) {}

void Refiner::refine(Partition& partition, std::vector<std::uint32_t> changed) {
  while (!changed.empty()) {
    look(partition, changed);
    changed.clear();
    for (std::size_t begin = 0, end = 0; begin < affected_.size(); begin = end) {
      while (end < affected_.size() && affected_[end].cls == affected_[begin].cls) ++end;
      split(partition, begin, end, changed);
    }
  }
}

void Refiner::look(const Partition& partition, std::span<const std::uint32_t> changed) {
  affected_.clear();
  rows_.clear();
  for (const std::uint32_t node : changed) {
    for (const std::uint32_t row : structure_.rows_of(node)) {
      if (row_done_[row]) continue;
      row_done_[row] = true;
      rows_.push_back(row);
      for (std::size_t i = 0; i < 4; ++i) {
        const BlankStructure::Field field = structure_.rows()[row][i];
        if (!field.is_blank) continue;
        const auto other = static_cast<std::uint32_t>(field.value);
        // A sum, because the order of the rows must not matter.
        view_[other] += hash_row(structure_.rows()[row], i, partition);
        if (!is_affected_[other]) affected_.push_back({partition.class_of[other], 0, other});
        is_affected_[other] = true;
      }
    }
  }
  for (const std::uint32_t row : rows_) row_done_[row] = false;
  for (Seen& seen : affected_) {
    seen.hash = view_[seen.node];
    view_[seen.node] = 0;
    is_affected_[seen.node] = false;
  }
  std::ranges::sort(affected_);
}

// The largest part keeps the class, so that the work is bounded (Hopcroft, 1971): what the other
// parts see settles what it sees. The members that are not affected are a part, too.
void Refiner::split(Partition& partition, std::size_t begin, std::size_t end,
                    std::vector<std::uint32_t>& changed) {
  const auto part_end = [&](std::size_t i) {
    const std::uint64_t hash = affected_[i].hash;
    while (i < end && affected_[i].hash == hash) ++i;
    return i;
  };
  std::size_t largest = end;
  std::size_t largest_size = partition.length[affected_[begin].cls] - (end - begin);
  for (std::size_t i = begin; i < end; i = part_end(i)) {
    if (part_end(i) - i > largest_size) {
      largest = i;
      largest_size = part_end(i) - i;
    }
  }
  for (std::size_t i = begin, next = begin; i < end; i = next) {
    next = part_end(i);
    if (i == largest) continue;
    group_.clear();
    for (std::size_t k = i; k < next; ++k) group_.push_back(affected_[k].node);
    partition.split(group_);
    changed.insert(changed.end(), group_.begin(), group_.end());
  }
}

std::vector<Id> ordered_blanks(std::span<const graph::Quad> quads, const graph::Terms& terms) {
  // A quad that comes twice says no more than once.
  std::vector<graph::Quad> distinct(quads.begin(), quads.end());
  std::ranges::sort(distinct);
  distinct.erase(std::ranges::unique(distinct).begin(), distinct.end());
  const BlankStructure structure(distinct, terms);
  std::vector<std::uint32_t> nodes(structure.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  Partition partition(static_cast<std::uint32_t>(nodes.size()));
  Refiner refiner(structure);
  refiner.refine(partition, nodes);
  // The members of a class are symmetric, so any of them may come first; what depends on it
  // follows.
  for (std::uint32_t cls = 0; cls < partition.class_count(); ++cls) {
    while (partition.length[cls] > 1) {
      const std::vector<std::uint32_t> chosen = {partition.members(cls).back()};
      partition.split(chosen);
      refiner.refine(partition, chosen);
    }
  }
  std::ranges::sort(nodes, {}, [&](std::uint32_t node) { return partition.class_of[node]; });
  std::vector<Id> ordered;
  ordered.reserve(nodes.size());
  for (const std::uint32_t node : nodes) ordered.push_back(structure.node(node));
  return ordered;
}

}  // namespace sinew::rdf
