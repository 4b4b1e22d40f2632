// Base inertial parameters: of each body, the part of the inertia that its predecessor could carry
// as well, because the joint between them cannot tell, is moved there (Gautier and Khalil 1990;
// Khalil and Kleinfinger 1987). Joint forces, accelerations and the mass matrix stay what they are,
// and of each moving body three to six of ten parameters become zero, which straight-line code need
// not compute with.
#pragma once

#include <array>
#include <unordered_map>

#include "sinew/synthesis/context.h"

namespace sinew::synthesis {

// Mass, first moment (3), rotational inertia (6) for each body that has any after regrouping.
using Inertias = std::unordered_map<Id, std::array<double, 10>>;

// As the model states them.
Inertias stated_inertias(const Context& context);

// A revolute joint about z lets the predecessor carry m, h_z and a thin rod along z, I = diag(a, a,
// 0) with a = (I_xx + I_yy - I_zz) / 2: turning about z changes none of them. A prismatic joint
// lets it carry all of I, since both bodies turn alike. What reaches a root that does not move is
// dropped.
void regroup(const Context& context, Inertias& inertias);

}  // namespace sinew::synthesis
