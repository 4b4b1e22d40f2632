// Rows of ids, each once, in the order in which they came: for DISTINCT, group keys and tables'
// keys.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "sinew/graph/terms.h"

namespace sinew::rdf::sparql::eval {

class RowSet {
 public:
  struct Result {
    std::size_t index;
    bool is_new;
  };
  void begin(std::size_t width) {
    width_ = width;
    cells.clear();
    count_ = 0;
    if (++epoch_ == 0) {
      table_.assign(table_.size(), {});
      epoch_ = 1;
    }
  }
  Result insert(std::span<const graph::Id> row) {
    if ((count_ + 1) * 2 > table_.size()) grow();
    std::size_t at = find(row);
    if (table_[at].epoch == epoch_) return {table_[at].index, false};
    table_[at] = {epoch_, static_cast<std::uint32_t>(count_)};
    cells.insert(cells.end(), row.begin(), row.end());
    return {count_++, true};
  }
  // The index of the row, or kNotThere.
  static constexpr std::size_t kNotThere = static_cast<std::size_t>(-1);
  std::size_t index_of(std::span<const graph::Id> row) const {
    if (table_.empty()) return kNotThere;
    const std::size_t at = find(row);
    return table_[at].epoch == epoch_ ? table_[at].index : kNotThere;
  }
  std::size_t size() const { return count_; }
  std::span<const graph::Id> row(std::size_t index) const {
    return {cells.data() + index * width_, width_};
  }

  std::vector<graph::Id> cells;

 private:
  struct Cell {
    std::uint32_t epoch = 0;
    std::uint32_t index = 0;
  };
  // Where the row is, or the empty cell where it would be.
  std::size_t find(std::span<const graph::Id> wanted) const {
    std::uint64_t hash = 0xCBF29CE484222325ull;
    for (const graph::Id id : wanted) {
      hash = (hash ^ id.value) * 0x9E3779B97F4A7C15ull;
      hash ^= hash >> 29;
    }
    const std::size_t mask = table_.size() - 1;
    std::size_t at = static_cast<std::size_t>(hash >> 20) & mask;
    while (table_[at].epoch == epoch_) {
      const auto candidate = row(table_[at].index);
      if (std::equal(candidate.begin(), candidate.end(), wanted.begin())) break;
      at = (at + 1) & mask;
    }
    return at;
  }
  void grow() {
    table_.assign(table_.empty() ? 64 : table_.size() * 2, {});
    for (std::size_t i = 0; i < count_; ++i) {
      table_[find(row(i))] = {epoch_, static_cast<std::uint32_t>(i)};
    }
  }

  std::vector<Cell> table_;
  std::size_t width_ = 0;
  std::size_t count_ = 0;
  std::uint32_t epoch_ = 0;
};

}  // namespace sinew::rdf::sparql::eval
