// A program whose limbs are computed side by side: regions that are evaluated one after the other,
// each a computation of its own, either on plain numbers (the trunk) or on vectors with one limb in
// each lane.
//
// The legs of a quadruped differ in their parameters, in their inputs and in nothing else; so the
// leg is recorded once, with a constant vector wherever the parameters differ and a plain constant
// where they agree. Link frames that normalisation has chosen alike make them agree in most places.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "sinew/program/dag/dag.h"
#include "sinew/program/dag/evaluate.h"
#include "sinew/program/passes/passes.h"
#include "sinew/program/program.h"

namespace sinew::program {

// Where one number comes from.
struct LimbSource {
  enum class Kind : std::uint8_t { kCaller, kConstant, kRegion } kind = Kind::kConstant;
  std::uint32_t index = 0;  // kCaller: as trace.h numbers inputs; kRegion: of the region's results
  std::uint32_t region = 0;
  std::uint32_t lane = 0;
  bool negative = false;  // kRegion: minus that result
  double value = 0.0;     // kConstant

  bool operator==(const LimbSource&) const = default;
};

// Lanes of the vector that holds these limbs; those that are left over repeat the first limb.
constexpr unsigned vector_width(std::uint32_t limbs) { return std::bit_ceil(limbs); }

struct LimbRegion {
  std::uint32_t lanes = 1;  // 1: plain numbers
  Computation computation;
  std::vector<std::vector<LimbSource>> inputs;  // [input of the computation][lane]
};

struct LimbProgram {
  std::uint32_t inputs = 0;  // numbers that the caller hands over
  std::vector<LimbRegion> regions;
  std::vector<LimbSource> results;

  // Operations, where one on a vector counts once.
  OperationCount operations() const;
};

// Nothing where there are no limbs; whether they pay is not asked. A program with states has none.
// Preconditions: the program is valid, without derivatives. Inputs and results are those of
// trace.h.
std::optional<LimbProgram> side_by_side(const Program& program,
                                        const OptimiseOptions& options = {});
// Whether vector operations save a fifth of all operations; `scalar` is the count of the program as
// one computation.
bool pays(const LimbProgram& limbs, const OperationCount& scalar);

// Nothing where there are no limbs, or where they would not pay.
std::optional<LimbProgram> limb_program(const Program& program, const OperationCount& scalar,
                                        const OptimiseOptions& options = {});

// Reference evaluation, for tests.
std::vector<double> evaluate(const LimbProgram& program, const std::vector<double>& inputs);

}  // namespace sinew::program
