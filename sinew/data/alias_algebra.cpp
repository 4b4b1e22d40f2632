#include "sinew/data/alias_algebra.h"

#include <set>

namespace sinew::data {

ElementMap identity_map(std::size_t size) {
  ElementMap map;
  for (std::size_t i = 0; i < size; ++i) map.images.push_back({i, 1, 0});
  return map;
}

ElementMap compose(const ElementMap& a, const ElementMap& b) {
  ElementMap result;
  for (const ElementMap::Image& first : a.images) {
    if (!first.element) {
      result.images.push_back(first);
      continue;
    }
    ElementMap::Image second = b.images[*first.element];
    second.sign *= first.sign;
    second.constant *= first.sign;
    result.images.push_back(second);
  }
  return result;
}

void AliasAlgebra::add(const std::string& left, const std::string& right, const ElementMap& map,
                       std::size_t right_size) {
  ElementMap back;
  back.images.resize(right_size);
  for (std::size_t i = 0; i < map.images.size(); ++i) {
    const auto& image = map.images[i];
    if (image.element) back.images[*image.element] = {i, image.sign, 0};
  }
  maps_[left].try_emplace(right, map);
  maps_[right].try_emplace(left, back);
}

std::vector<std::pair<std::string, ElementMap>> AliasAlgebra::reachable(const std::string& from,
                                                                        std::size_t size) const {
  std::vector<std::pair<std::string, ElementMap>> found = {{from, identity_map(size)}};
  std::set<std::string> seen = {from};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto neighbours = maps_.find(found[i].first);
    if (neighbours == maps_.end()) continue;
    for (const auto& [name, map] : neighbours->second) {
      if (seen.insert(name).second) found.emplace_back(name, compose(found[i].second, map));
    }
  }
  return found;
}

std::optional<ElementMap> AliasAlgebra::find(const std::string& from, const std::string& to,
                                             std::size_t size) const {
  for (auto& [name, map] : reachable(from, size)) {
    if (name == to) return map;
  }
  return std::nullopt;
}

}  // namespace sinew::data
