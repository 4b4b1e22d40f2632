// Numbers and names as C source text, the same on every machine and in every locale.
#pragma once

#include <string>
#include <string_view>

namespace sinew::backend {

// The shortest decimal that reads back as exactly this double; always of floating type ("2.0").
// Precondition: finite.
std::string c_number(double value);
std::string c_number(float value);  // without the suffix

// "NAME" for the macros of the function "name".
std::string upper_case(std::string text);

// A text as a C identifier: every other character becomes '_', and a leading digit or an empty text
// gets one in front.
std::string c_identifier(std::string_view text);

// Whether a text can name a function in C and C++.
bool is_c_function_name(std::string_view text);

// A text that can stand inside a block comment on one line.
std::string c_comment(std::string_view text);

}  // namespace sinew::backend
