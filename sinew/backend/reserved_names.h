// Names that a function of generated code cannot have, because the languages, their libraries or
// compilers have them already: such code would not compile, or not link into every program.
#pragma once

#include <string_view>

namespace sinew::backend {

bool is_reserved_in_c(std::string_view name);

}  // namespace sinew::backend
