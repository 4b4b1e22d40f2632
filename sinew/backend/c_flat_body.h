// The statements of a flat function, for one sample or for a block of samples; internal to
// `backend`.
#pragma once

#include <string>

#include "sinew/backend/c_parts.h"

namespace sinew::backend {

enum class FlatForm {
  kSample,  // numbers are double; input i is in[i]
  kBlock,   // numbers are NAME_lanes, one sample in each lane; input i lies at in + i * n
};

struct FlatBody {
  CodeBlock parts;  // functions that `code` calls; empty for all but very long programs
  CodeBlock code;
  std::size_t angles = 0;  // whose sine or cosine is taken
};

FlatBody flat_body(const program::Program& program, const program::Interface& interface,
                   const program::Computation& computation, const std::string& name, FlatForm form,
                   std::size_t maximum_statements);

}  // namespace sinew::backend
