// The array in which values of a long flat function wait, and the pointers through which they are
// read, as C: the same in functions with and without limbs. Internal to `backend`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/backend/c_names.h"
#include "sinew/backend/c_parts.h"

namespace sinew::backend {

// Declares the array, `size` > 0 numbers of type `scalar`, and the pointers into it, whose names it
// adds to `pointers`. `upper` is the function's name in upper case.
void declare_kept_array(std::uint32_t size, std::string_view upper, std::string_view scalar,
                        CNames& given, std::vector<std::string>& pointers, CodeBlock& code);

// From here on a compiler cannot know what the pointer points to.
void point_again(std::string_view pointer, std::string_view upper, CodeBlock& code);

}  // namespace sinew::backend
