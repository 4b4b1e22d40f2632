// A set of variables as a sorted array: sets are small, and most are made once and only read.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <vector>

namespace sinew::rdf::sparql::algebra {

using Variable = std::uint32_t;

class VariableSet {
 public:
  VariableSet() = default;
  VariableSet(std::initializer_list<Variable> list) {
    for (const Variable variable : list) add(variable);
  }

  bool has(Variable variable) const {
    return std::binary_search(items_.begin(), items_.end(), variable);
  }
  void add(Variable variable) {
    const auto at = std::lower_bound(items_.begin(), items_.end(), variable);
    if (at == items_.end() || *at != variable) items_.insert(at, variable);
  }
  void add(const VariableSet& other) {
    // Most sets that are added are small, and most of their variables are here already or are newer
    // than all that are here.
    constexpr std::size_t kSmall = 8;
    if (other.items_.size() <= kSmall) {
      for (const Variable variable : other.items_) add(variable);
      return;
    }
    std::vector<Variable> merged;
    merged.reserve(items_.size() + other.items_.size());
    std::set_union(items_.begin(), items_.end(), other.items_.begin(), other.items_.end(),
                   std::back_inserter(merged));
    items_ = std::move(merged);
  }
  void remove(Variable variable) {
    const auto at = std::lower_bound(items_.begin(), items_.end(), variable);
    if (at != items_.end() && *at == variable) items_.erase(at);
  }
  void keep_only(const VariableSet& other) {
    std::erase_if(items_, [&](Variable variable) { return !other.has(variable); });
  }
  void remove(const VariableSet& other) {
    std::erase_if(items_, [&](Variable variable) { return other.has(variable); });
  }
  bool intersects(const VariableSet& other) const {
    auto left = items_.begin();
    auto right = other.items_.begin();
    while (left != items_.end() && right != other.items_.end()) {
      if (*left == *right) return true;
      *left < *right ? ++left : ++right;
    }
    return false;
  }
  bool is_subset_of(const VariableSet& other) const {
    return std::includes(other.items_.begin(), other.items_.end(), items_.begin(), items_.end());
  }
  bool empty() const { return items_.empty(); }
  std::size_t size() const { return items_.size(); }
  auto begin() const { return items_.begin(); }
  auto end() const { return items_.end(); }
  friend bool operator==(const VariableSet&, const VariableSet&) = default;

 private:
  std::vector<Variable> items_;
};

}  // namespace sinew::rdf::sparql::algebra
