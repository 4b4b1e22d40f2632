// The statements that write results that are always zero; internal to `backend`.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "sinew/backend/c_names.h"
#include "sinew/backend/c_parts.h"

namespace sinew::backend {

struct ZeroStyle {
  std::string array;   // "out"
  std::string number;  // "0.0"
  std::string prefix;  // of the macros, in capitals
};

// `places`: in the array, in any order.
void write_zeros(CodeBlock& code, CNames& given, const ZeroStyle& style,
                 std::span<const std::uint32_t> places);

}  // namespace sinew::backend
