// One sample of a program with its limbs side by side.
#pragma once

#include "sinew/backend/jit/place.h"
#include "sinew/program/limbs/limb_program.h"

namespace sinew::backend {

// Writes the whole function; `number` is float or double.
void emit_limbs(const program::LimbProgram& program, const Place& place, LLVMTypeRef number);

}  // namespace sinew::backend
