// The statements of a flat function in which limbs are computed side by side; internal to
// `backend`.
#pragma once

#include <string>
#include <vector>

#include "sinew/backend/c_flat_body.h"
#include "sinew/program/limbs/limb_program.h"

namespace sinew::backend {

struct LimbBody {
  CodeBlock parts;                      // the table of its constants, if it has one
  std::vector<std::string> part_names;  // as FlatBody has them
  CodeBlock code;
  std::vector<unsigned> widths;  // of the vector types that it names: NAME_limbs4, …
  std::size_t angles = 0;        // whose sine or cosine is taken
};

// One sample, as FlatForm::kSample; the options' form and parts do not matter.
LimbBody limb_body(const program::LimbProgram& program, const FlatLayout& layout,
                   const FlatOptions& options);

}  // namespace sinew::backend
