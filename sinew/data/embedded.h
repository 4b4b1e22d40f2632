// The data files that the library carries within itself: metamodels/units.json and
// metamodels/blocks/.
#pragma once

#include <string_view>

namespace sinew::data {

// The text of a file by its path below metamodels/; throws Error where there is none.
std::string_view embedded_file(std::string_view path);

}  // namespace sinew::data
