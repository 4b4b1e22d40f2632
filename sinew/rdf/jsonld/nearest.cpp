#include "sinew/rdf/jsonld/nearest.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace sinew::jsonld {
namespace {

// Longer words are not compared: the table would cost more than the suggestion is worth.
constexpr std::size_t kLongestWord = 200;

// A third of the characters may be wrong, and at least two.
std::size_t tolerance(std::string_view word) {
  return word.size() <= 3 ? 1 : std::max<std::size_t>(2, word.size() / 3);
}

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
  const std::size_t difference = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
  if (difference > limit || std::max(a.size(), b.size()) > kLongestWord) return limit + 1;
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
          lower(a[i - 2]) == lower(b[j - 1])) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    before.swap(last);
    last.swap(row);
  }
  return std::min(last[b.size()], limit + 1);
}

Nearest::Nearest(std::string_view wanted) : wanted_(wanted), limit_(tolerance(wanted)) {}

void Nearest::offer(std::string_view candidate) {
  const std::size_t distance = edit_distance(wanted_, candidate, limit_);
  if (distance > limit_) return;
  if (distance == limit_ && !found_.empty() && candidate >= found_) return;
  limit_ = distance;
  found_ = candidate;
}

}  // namespace sinew::jsonld
