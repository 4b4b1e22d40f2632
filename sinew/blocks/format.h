// Syntax tree to text, in one normal form: `sinew blocks fmt`. What it writes is read back as the
// same tree, and formatting it again changes nothing. Comments stay.
#pragma once

#include <string>

#include "sinew/blocks/syntax.h"

namespace sinew::blocks {

constexpr std::size_t kLineWidth = 100;

std::string format(const Node& file);

}  // namespace sinew::blocks
