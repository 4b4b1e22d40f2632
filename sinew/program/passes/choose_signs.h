// Chooses which values are computed with the other sign, so that few are negated: where results are
// the negative of what was computed, what computes them turns its own sign. The graph's
// constructors give each node one form (a product is positive, the first term of a sum is), which
// is what the other passes need to see that two are the same; this one comes behind all that look
// for that. From here on constants may be negative, and the first operand of a sum too where the
// second one is.
//
// Nothing is rounded otherwise: only a zero may have another sign.
#pragma once

#include <cstdint>
#include <span>

#include "sinew/program/dag/dag.h"
#include "sinew/program/passes/sign_choice.h"

namespace sinew::program {

Computation choose_signs(Computation computation);

// Negations that are left for a processor that fuses multiplications with additions and
// subtractions; what is negated for several results counts once.
std::uint32_t count_negations(const Computation& computation);

// For limbs, whose computations read from each other. The nodes of a computation are the values
// from `first` on; of its inputs and its results nothing is said.
void add_nodes(const Computation& computation, std::uint32_t first, SignChoice& choice);
// The computation with the signs that were chosen for those values.
Computation with_signs(const Computation& computation, std::uint32_t first,
                       const SignChoice& choice);

}  // namespace sinew::program
