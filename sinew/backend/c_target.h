// Programs as C source: three self-contained files with the interface of design.md, "Program and
// generated code"; or as CUDA source with one thread a sample. The same program gives the same
// bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/program/dag/evaluate.h"
#include "sinew/program/partial.h"
#include "sinew/program/passes/passes.h"
#include "sinew/program/program.h"

namespace sinew::backend {

enum class Style {
  kFlat,      // optimised straight-line code; C11 and libm
  kReadable,  // one call for each closure to the functions of math/sinew_math.h
};

enum class Scalar {
  kDouble,
  kFloat,  // flat style only: all numbers are float, constants are rounded to it
};

// Where sines and cosines come from, in flat C.
enum class Trigonometry {
  kOwn,    // polynomials that are part of the code; libm for far angles
  kSleef,  // the library SLEEF, which the code includes and has to be linked with
};

enum class Language {
  kC,
  kCpp,   // the same functions in NAME.cpp, and NAME.hpp with their numbers by name
  kCuda,  // flat style only: NAME.h, NAME.cu and NAME.json
};

struct COptions {
  std::string name;  // of the function and of the files
  Style style = Style::kFlat;
  std::string source = {};  // what it was made from, for the banner: "gen3.urdf, solver rnea"
  Scalar scalar = Scalar::kDouble;
  Language language = Language::kC;
  Trigonometry trigonometry = Trigonometry::kOwn;
  program::OptimiseOptions passes = {};
  // Flat style only: what NAME_update computes, beside what the program itself says to be held.
  program::PartialOptions partial = {};
  // Limbs that are alike are computed side by side where that pays (program/limbs), in single calls
  // of flat C.
  bool limbs = true;
  std::size_t maximum_statements = 4000;  // of one flat function; more become several functions
  bool one_thread = false;  // limbs of large programs are otherwise optimised on a thread beside
};

struct SourceFile {
  std::string name;  // without folder
  std::string text;
};

struct GeneratedCode {
  std::vector<SourceFile> files;       // NAME.h; NAME.c, .cpp or .cu; NAME.json; C++: NAME.hpp
  program::OperationCount operations;  // of one evaluation of the flat style
  program::OperationCount update;      // of one call of NAME_update
  bool has_update = false;             // false where nothing is slow or held that is worth keeping
  // Where limbs are side by side: operations of a single call, one on a vector counted once.
  std::optional<program::OperationCount> with_limbs;
};

// Throws Error if the program is not valid, the name cannot name a C function, a name in `partial`
// fits nothing, a constant does not fit into the scalar, or the style cannot do what is asked.
GeneratedCode generate_c(program::Program program, const COptions& options);

}  // namespace sinew::backend
