// The data blocks of a running algorithm: numbers in memory, found by the IRIs of their models.
//
// The layout is fixed when it is made: one allocation, every block on a cache line of its own, so
// that a pointer into it stays good and two threads that use different blocks do not slow each
// other down. It is not thread-safe; the host's loop owns it.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sinew/base/cache_lines.h"
#include "sinew/program/program.h"

namespace sinew::runtime {

inline constexpr std::uint32_t kNoBlock = 0xffffffffU;

class Storage {
 public:
  explicit Storage(std::vector<program::Variable> blocks);

  std::size_t size() const { return blocks_.size(); }
  const program::Variable& about(std::uint32_t block) const { return blocks_[block]; }
  std::span<double> numbers(std::uint32_t block) {
    return {numbers_.data() + offsets_[block], blocks_[block].size};
  }
  std::span<const double> numbers(std::uint32_t block) const {
    return {numbers_.data() + offsets_[block], blocks_[block].size};
  }

  // By IRI, or by name ("force.joint1"); kNoBlock when there is none.
  std::uint32_t find(std::string_view iri_or_name) const;

  // Every block to its first value: what its model says, otherwise 0.
  void reset();

 private:
  std::vector<program::Variable> blocks_;
  std::vector<std::size_t> offsets_;
  CacheLineVector<double> numbers_;
  std::unordered_map<std::string_view, std::uint32_t> by_iri_, by_name_;
};

// Whether a value of one block means the same in the other: quantity, unit, frame and size.
bool same_prototype(const program::Variable& a, const program::Variable& b);

}  // namespace sinew::runtime
