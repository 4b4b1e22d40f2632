#include "sinew/runtime/storage.h"

#include <algorithm>
#include <new>

#include "sinew/runtime/ring.h"

namespace sinew::runtime {

void Storage::Free::operator()(double* numbers) const {
  ::operator delete[](numbers, std::align_val_t{kCacheLine});
}

Storage::Storage(std::vector<program::Variable> blocks) : blocks_(std::move(blocks)) {
  constexpr std::size_t kLine = kCacheLine / sizeof(double);
  for (std::uint32_t i = 0; i < blocks_.size(); ++i) {
    offsets_.push_back(count_);
    count_ += (blocks_[i].size + kLine - 1) / kLine * kLine;
    by_iri_.emplace(blocks_[i].iri, i);
    by_name_.emplace(blocks_[i].name, i);
  }
  numbers_.reset(static_cast<double*>(::operator new[](
      std::max<std::size_t>(count_, 1) * sizeof(double), std::align_val_t{kCacheLine})));
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
  std::fill_n(numbers_.get(), count_, 0.0);
  for (std::uint32_t i = 0; i < blocks_.size(); ++i)
    std::copy(blocks_[i].value.begin(), blocks_[i].value.end(), numbers(i).begin());
}

bool same_prototype(const program::Variable& a, const program::Variable& b) {
  return a.size == b.size && a.quantity == b.quantity && a.unit == b.unit && a.frame == b.frame;
}

}  // namespace sinew::runtime
