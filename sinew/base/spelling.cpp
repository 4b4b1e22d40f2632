#include "sinew/base/spelling.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace sinew {
namespace {

std::size_t tolerated_edits(std::string_view text) {
  return text.size() <= 3 ? 1 : std::max<std::size_t>(2, text.size() / 3);
}

std::size_t replacement(char a, char b) {
  if (a == b) return 0;
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return lower(a) == lower(b) ? 1 : kOneEdit;
}

}  // namespace

std::size_t spelling_distance(std::string_view a, std::string_view b, std::size_t limit) {
  const std::size_t longer = std::max(a.size(), b.size()), shorter = std::min(a.size(), b.size());
  if (kOneEdit * (longer - shorter) > limit || longer > kLongestComparedWord) return limit + 1;
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = kOneEdit * j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = kOneEdit * i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + kOneEdit, row[j - 1] + kOneEdit,
                         last[j - 1] + replacement(a[i - 1], b[j - 1])});
      if (i < 2 || j < 2) continue;
      const std::size_t swapped = replacement(a[i - 1], b[j - 2]) + replacement(a[i - 2], b[j - 1]);
      if (swapped < kOneEdit) row[j] = std::min(row[j], before[j - 2] + kOneEdit + swapped);
    }
    before.swap(last);
    last.swap(row);
  }
  return std::min(last[b.size()], limit + 1);
}

std::vector<std::string> close_spellings(std::string_view text, std::span<const std::string> names,
                                         std::size_t limit) {
  // Changes of case beside the edits: fewer than one more edit.
  const std::size_t farthest = kOneEdit * tolerated_edits(text) + kOneEdit - 1;
  std::vector<std::pair<std::size_t, std::string>> close;
  for (const std::string& name : names) {
    const std::size_t distance = spelling_distance(text, name, farthest);
    if (distance <= farthest) close.emplace_back(distance, name);
  }
  std::sort(close.begin(), close.end());
  close.erase(std::unique(close.begin(), close.end()), close.end());
  if (!close.empty()) {
    const std::size_t fewest = close.front().first / kOneEdit;
    std::erase_if(close, [&](const auto& each) { return each.first / kOneEdit > fewest; });
  }
  if (close.size() > limit) close.resize(limit);
  std::vector<std::string> result;
  for (auto& [distance, name] : close) result.push_back(std::move(name));
  return result;
}

std::string did_you_mean(std::string_view text, std::span<const std::string> names,
                         const std::string& otherwise) {
  const auto close = close_spellings(text, names);
  if (close.empty()) return otherwise;
  return fmt::format("did you mean {}?", fmt::join(close, " or "));
}

}  // namespace sinew
