// "Did you mean …?": names that are close to a misspelt one.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::data {

// At most `limit` of `names` within a third of the text's length in edits (insert, delete, replace,
// swap of neighbours; a change of case counts as none), the closest first, equals by name.
std::vector<std::string> close_spellings(std::string_view text, std::span<const std::string> names,
                                         std::size_t limit = 3);

// "; did you mean X?" and the like, ready to be a remedy; `otherwise` when nothing is close.
std::string did_you_mean(std::string_view text, std::span<const std::string> names,
                         const std::string& otherwise);

}  // namespace sinew::data
