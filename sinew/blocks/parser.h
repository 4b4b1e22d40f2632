// Text to syntax tree. After a fault the parser goes on with the next item, so that one run tells
// of all of them, each with its place and, for misspelt words, a suggestion.
//
// This reads the half of the language that describes data. Items of the other half (load, fblx,
// dblx, composed fprotos, statements) are refused by name.
#pragma once

#include <string>
#include <string_view>

#include "sinew/blocks/syntax.h"

namespace sinew::blocks {

// Throws Error with every fault.
Node parse(std::string_view text, const std::string& file);

// The words that begin an item.
const std::vector<std::string>& item_keywords();

}  // namespace sinew::blocks
