// The program's JSON form, version 1 (docs/program.md): written with stable bytes, read strictly.
#pragma once

#include <string>
#include <string_view>

#include "sinew/program/program.h"

namespace sinew::program {

inline constexpr int kProgramJsonVersion = 1;
inline constexpr std::size_t kMaximumProgramBytes = 256U << 20U;  // of JSON text; beyond: Error
inline constexpr std::size_t kMaximumProgramDepth = 8;            // of nesting; beyond: Error
inline constexpr std::size_t kMaximumVariableSize = 1U << 20U;    // numbers; beyond: Error

std::string to_json(const Program& program);

// Throws Error, naming `file` and the line where it is known, for anything that is not such a
// program: no field may be missing, unknown or of another type. The result is valid
// (program/validate.h).
Program from_json(std::string_view text, const std::string& file);

}  // namespace sinew::program
