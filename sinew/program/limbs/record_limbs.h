// From the closures of a program and its limbs to regions: what each closure computes is traced
// once for all limbs, on constants and inputs with a number for each.
#pragma once

#include <optional>

#include "sinew/program/limbs/find_limbs.h"
#include "sinew/program/limbs/limb_program.h"
#include "sinew/program/program.h"

namespace sinew::program {

// The regions as they were traced: nothing is simplified or left out yet. Nothing where a limb
// needs a result of another one on the way, for then they are not side by side. Precondition: the
// program has no states.
std::optional<LimbProgram> record_limbs(const Program& program, const Limbs& limbs);

}  // namespace sinew::program
