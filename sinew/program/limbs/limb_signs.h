// The signs of a program with limbs side by side, chosen for all its regions at once
// (passes/choose_signs.h): a region that reads the negative of another's result turns its own sums
// instead of negating lane after lane, and constants that differ between limbs turn theirs.
#pragma once

#include <cstdint>

#include "sinew/program/limbs/limb_program.h"

namespace sinew::program {

void choose_signs(LimbProgram& program);

// Negations that are left; one of a vector counts once, and so does a result of which several lanes
// are negated.
std::uint32_t count_negations(const LimbProgram& program);

// Whether these are the lanes of one result, in their order.
bool is_whole_vector(const LimbProgram& program, const std::vector<LimbSource>& sources);

// The negative of a number, with the sign that it already has. Precondition: not the caller's.
LimbSource negated(LimbSource source);

}  // namespace sinew::program
