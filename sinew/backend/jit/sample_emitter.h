// The function of one sample, with limbs side by side where the program has them.
#pragma once

#include <cstdint>

#include "sinew/backend/jit/place.h"
#include "sinew/program/limbs/limb_program.h"

namespace sinew::backend {

// A computation without limbs.
program::LimbProgram as_one_region(const program::Computation& computation);

// Writes the whole function, with so many values in registers; `number` is float or double.
void emit_sample(const program::LimbProgram& program, const Place& place, LLVMTypeRef number,
                 std::uint32_t registers);

}  // namespace sinew::backend
