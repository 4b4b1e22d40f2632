// From what a file says to declarations with fully qualified names: modules become prefixes,
// imports are followed, references find the innermost name that fits, and what the prelude declares
// is added where it is needed.
//
// A name is looked for in its own module, then in each module around it, then in the prelude. What
// a file declares may therefore have the same name as something in the prelude.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/blocks/syntax.h"
#include "sinew/data/declarations.h"
#include "sinew/data/library.h"

namespace sinew::blocks {

// How many files one file may import, all in all.
constexpr std::size_t kMaximumImports = 1000;

// The prelude: the domain geometry with its coordinates and formulas, and some common forms, units
// and functions. Its names begin with "prelude.", except for the domains'.
const Node& prelude();

// Throws Error with every fault that can be found without checking the declarations themselves.
data::Declarations elaborate(const Node& file);

struct LoadOptions {
  std::vector<std::string>
      type_directories;  // looked through for .msg, .asn, .idl … before the usual places
};
// Reads, parses, elaborates and checks a file.
data::Library load_library(const std::string& file, const LoadOptions& options = {});
// The same for a text; `file` names it in errors, and imports and types are looked for beside it.
data::Library load_library(std::string_view text, const std::string& file,
                           const LoadOptions& options = {});
data::Library load_library(const Node& file, const LoadOptions& options = {});

}  // namespace sinew::blocks
