// Programs as C source: three self-contained files with the interface of design.md, "Program and
// generated code". The same program gives the same bytes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/program/dag/evaluate.h"
#include "sinew/program/passes/passes.h"
#include "sinew/program/program.h"

namespace sinew::backend {

enum class Style {
  kFlat,      // optimised straight-line code; C11 and libm
  kReadable,  // one call for each closure to the functions of math/sinew_math.h
};

struct COptions {
  std::string name;  // of the function and of the files
  Style style = Style::kFlat;
  std::string source;  // what it was made from, for the banner: "gen3.urdf, solver rnea"
  program::OptimiseOptions passes;
  std::size_t maximum_statements = 4000;  // of one flat function; more become several functions
};

struct SourceFile {
  std::string name;  // without folder
  std::string text;
};

struct GeneratedCode {
  std::vector<SourceFile> files;       // NAME.h, NAME.c, NAME.json
  program::OperationCount operations;  // of one evaluation of the flat style
};

// Throws Error if the program is not valid or the name cannot name a C function.
GeneratedCode generate_c(const program::Program& program, const COptions& options);

}  // namespace sinew::backend
