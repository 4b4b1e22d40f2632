// The statements of a flat function, for one sample or for a block of samples; internal to
// `backend`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sinew/backend/c_parts.h"

namespace sinew::backend {

enum class FlatForm {
  kSample,  // numbers are scalars; input i is in[i]
  kBlock,   // numbers are NAME_lanes, one sample in each lane; input i lies at in + i * n
  kThread,  // CUDA: numbers are scalars; input i is in[i * n]
};

// Where a number lies. All arrays but `held` have one number for each sample.
struct FlatPlace {
  const char* array = "in";
  std::uint32_t index = 0;
};

// What a flat function reads and writes.
struct FlatLayout {
  std::vector<FlatPlace> inputs;         // of the computation
  std::vector<std::string> input_names;  // identifiers; a second use gets a number
  std::vector<FlatPlace> results;
  std::uint32_t in_size = 0;  // numbers that may be read in `in`
};

struct FlatOptions {
  std::string name;  // of the function; prefix of its types and parts
  FlatForm form = FlatForm::kSample;
  Scalar scalar = Scalar::kDouble;
  std::string of;  // "sample" or "update": tells apart the parts of two functions
  std::size_t maximum_statements = 4000;
};

struct FlatBody {
  CodeBlock parts;  // functions that `code` calls; empty for all but very long programs
  std::vector<std::string> part_names;  // of those functions, without the prefix
  CodeBlock code;
  std::size_t angles = 0;  // whose sine or cosine is taken
};

struct FlatPlan;  // c_flat_plan.h

// Throws Error for a constant that the scalar cannot hold.
FlatBody flat_body(const program::Computation& computation, const FlatLayout& layout,
                   const FlatOptions& options, const FlatPlan& plan);

// A number of the scalar type as C source. Throws Error where a float cannot hold it.
std::string scalar_number(double value, Scalar scalar);

// The layout of a program's evaluation, and that of its update (all results go to `held`), with the
// identifiers of its variables.
FlatLayout evaluation_layout(const program::Program& program, const program::Interface& interface,
                             const std::vector<std::string>& identifiers,
                             const program::Computation& evaluation);
FlatLayout update_layout(const program::Program& program, const program::Interface& interface,
                         const std::vector<std::string>& identifiers,
                         const program::Computation& update);

}  // namespace sinew::backend
