// "Did you mean …?": names that are close to a misspelt one. Every suggestion is made here.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

// How far two spellings are apart: an insertion, removal, replacement or swap of neighbours counts
// kOneEdit, a change of case 1 (optimal string alignment distance). More than `limit`: limit + 1.
inline constexpr std::size_t kOneEdit = 64;
std::size_t spelling_distance(std::string_view a, std::string_view b, std::size_t limit);

// Longer words are not compared: the table would cost more than the suggestion is worth.
inline constexpr std::size_t kLongestComparedWord = 200;

// At most `limit` of `names`, the closest first, equals by name. A third of the characters may be
// wrong, of four and more at least two, of fewer one; those that take more edits than the closest,
// be it none but changes of case, are left out.
std::vector<std::string> close_spellings(std::string_view text, std::span<const std::string> names,
                                         std::size_t limit = 3);

// "did you mean X?" or "did you mean X or Y?", ready to be a remedy; `otherwise` when nothing is
// close.
std::string did_you_mean(std::string_view text, std::span<const std::string> names,
                         const std::string& otherwise);

}  // namespace sinew
