// How types are named and declared in C and C++ source. Internal to the module.
#pragma once

#include <string>
#include <vector>

#include "sinew/data/emit.h"
#include "sinew/data/representation.h"

namespace sinew::data {

// A type's name; not for arrays.
std::string type_name(const Type& type, SourceLanguage language);
// A declaration without its semicolon: "double x[3]", "struct pose p".
std::string declare(const Type& type, const std::string& name, SourceLanguage language);
// Includes of the headers that declare the types, and declarations of those that no header does. A
// program that has a type already defines SINEW_HAVE_<type> before.
std::string emit_type_declarations(const std::vector<const Representation*>& representations,
                                   SourceLanguage language);

}  // namespace sinew::data
