// Aliases as maps between algebraic forms. Aliases chain: with a <-> b and b <-> c, a element of a
// has its counterpart in c.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sinew/data/algebraic.h"

namespace sinew::data {

// For each element of one form, what it is in another one.
struct ElementMap {
  struct Image {
    std::optional<std::size_t> element;  // in the other form; nothing: a constant here
    double sign = 1;
    double constant = 0;
    friend bool operator==(const Image&, const Image&) = default;
  };
  std::vector<Image> images;
  friend bool operator==(const ElementMap&, const ElementMap&) = default;
};

ElementMap identity_map(std::size_t size);
// First a, then b; nothing when an element that goes on is a constant on the way.
ElementMap compose(const ElementMap& a, const ElementMap& b);

class AliasAlgebra {
 public:
  // `map` leads from left to right; `right_size` is the number of elements there.
  void add(const std::string& left, const std::string& right, const ElementMap& map,
           std::size_t right_size);
  // All forms that can be reached, with the map there; the form itself first, then by distance and
  // name.
  std::vector<std::pair<std::string, ElementMap>> reachable(const std::string& from,
                                                            std::size_t size) const;
  std::optional<ElementMap> find(const std::string& from, const std::string& to,
                                 std::size_t size) const;

 private:
  std::map<std::string, std::map<std::string, ElementMap>> maps_;
};

}  // namespace sinew::data
