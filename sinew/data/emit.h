// A conversion as source code: one header with one inline function over the real types.
//
//   C    static inline void SOURCE_to_TARGET(const S* source, T* target);
//   C++  inline void SOURCE_to_TARGET(const S& source, T& target);
//
// The relations between frames that a change of conventions computes with follow as parameters of
// their own: `const P& tool_in_base`.
//
// Where a type grows while it runs (std::vector, asn1c's lists), the function returns bool instead:
// false, with the target untouched, when there are too few elements on either side; it never
// allocates.
#pragma once

#include <string>

#include "sinew/data/program.h"

namespace sinew::data {

enum class SourceLanguage : std::uint8_t { kC, kCpp };

struct EmitOptions {
  SourceLanguage language = SourceLanguage::kCpp;
  std::string function_name;  // SOURCE_to_TARGET when empty
  std::string origin;         // the file that the prototypes are from, for the banner
};

// Throws Error when the language cannot reach one of the types.
std::string emit(const Library& library, const Plan& plan, const EmitOptions& options);

}  // namespace sinew::data
