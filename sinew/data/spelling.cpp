#include "sinew/data/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace sinew::data {
namespace {

// Optimal string alignment distance, case folded.
std::size_t edits(std::string_view a, std::string_view b) {
  const auto same = [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  };
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] =
          std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1)});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1])) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::vector<std::string> close_spellings(std::string_view text, std::span<const std::string> names,
                                         std::size_t limit) {
  std::vector<std::pair<std::size_t, std::string>> close;
  for (const std::string& name : names) {
    const std::size_t distance = edits(text, name);
    if (distance <= std::max<std::size_t>(1, text.size() / 3)) close.emplace_back(distance, name);
  }
  std::sort(close.begin(), close.end());
  close.erase(std::unique(close.begin(), close.end()), close.end());
  std::vector<std::string> result;
  for (const auto& [distance, name] : close) {
    if (result.size() < limit) result.push_back(name);
  }
  return result;
}

std::string did_you_mean(std::string_view text, std::span<const std::string> names,
                         const std::string& otherwise) {
  const auto close = close_spellings(text, names);
  if (close.empty()) return otherwise;
  return fmt::format("did you mean {}?", fmt::join(close, " or "));
}

}  // namespace sinew::data
