#include "sinew/runtime/storage.h"

#include <algorithm>

namespace sinew::runtime {

Storage::Storage(std::vector<program::Variable> blocks) : blocks_(std::move(blocks)) {
  constexpr std::size_t kLine = kCacheLine / sizeof(double);
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < blocks_.size(); ++i) {
    offsets_.push_back(count);
    count += (blocks_[i].size + kLine - 1) / kLine * kLine;
    by_iri_.emplace(blocks_[i].iri, i);
    by_name_.emplace(blocks_[i].name, i);
  }
  numbers_.resize(count);
  reset();
}

std::uint32_t Storage::find(std::string_view iri_or_name) const {
  for (const auto* index : {&by_iri_, &by_name_}) {
    const auto found = index->find(iri_or_name);
    if (found != index->end()) return found->second;
  }
  return kNoBlock;
}

void Storage::reset() {
  std::fill(numbers_.begin(), numbers_.end(), 0.0);
  for (std::uint32_t i = 0; i < blocks_.size(); ++i)
    std::copy(blocks_[i].value.begin(), blocks_[i].value.end(), numbers(i).begin());
}

bool same_prototype(const program::Variable& a, const program::Variable& b) {
  return a.size == b.size && a.quantity == b.quantity && a.unit == b.unit && a.frame == b.frame;
}

}  // namespace sinew::runtime
