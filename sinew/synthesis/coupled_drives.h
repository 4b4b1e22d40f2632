// Hybrid dynamics where some joints follow others. A joint that gives way takes those that follow
// it along, wherever in the tree they are: articulated bodies do not know of each other then, and
// the recursion through one joint at a time does not close. What takes its place are the factors of
// the mass matrix of the coordinates, M = L^T D L. For forces tau of one effect on all coordinates
//   e = L^-T tau
// is what drives each coordinate while those after it give way, and D what each resists with; where
// no joint follows another they are the e and D of the recursion itself. So all that comes after is
// the same: energies e_i^T D^-1 e_k couple the constraints, and accelerations follow from
// D L qdd = e, from the base outward.
#pragma once

#include "sinew/synthesis/effects.h"

namespace sinew::synthesis {

// What drives all coordinates because of an effect, after the step "coupled-effects".
BlockIndex drive_of(Context& context, Id effect);

// The acceleration energy that one effect causes along another; `energy` is where it goes.
void energy_of_drives(Context& context, Id effect, Id other, BlockIndex energy, Id about);

}  // namespace sinew::synthesis
