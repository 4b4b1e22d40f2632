// The nearest of several words, for "did you mean …?".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sinew::jsonld {

// How many characters have to be inserted, removed, replaced, or swapped with their neighbour to
// turn one word into the other (optimal string alignment distance); `limit` + 1 if more than that.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit);

class Nearest {
 public:
  explicit Nearest(std::string_view wanted);
  void offer(std::string_view candidate);
  // The best candidate so far; empty when none is similar. Among equally near ones, the first in
  // lexicographic order.
  const std::string& found() const { return found_; }

 private:
  std::string_view wanted_;
  std::size_t limit_;
  std::string found_;
};

}  // namespace sinew::jsonld
