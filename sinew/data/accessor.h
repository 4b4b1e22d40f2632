// How one number of a value is named: "x", "im.0", "pose.position.x" by names and indices, "{2}" or
// "{0,3}" by the row and column of a vector or matrix.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::data {

// The largest index that an accessor may hold; a guard against overflow, far above any real layout.
constexpr std::size_t kMaximumIndex = 1'000'000;

struct Accessor {
  bool braces = false;  // {row} or {row,column}
  std::vector<std::string>
      steps;  // names or decimal indices; the one or two numbers inside the braces

  friend auto operator<=>(const Accessor&, const Accessor&) = default;
};

std::string to_string(const Accessor& accessor);
// Takes what to_string writes, spaces inside the braces allowed; nothing for anything else.
std::optional<Accessor> parse_accessor(std::string_view text);
// A step as an index; nothing when it is a name or exceeds kMaximumIndex.
std::optional<std::size_t> index_of(std::string_view step);

}  // namespace sinew::data
