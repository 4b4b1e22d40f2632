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
//
// A point of the axis between two bodies may as well give mass back to the successor, so that the
// predecessor's first moment loses its entry along the offset of that axis. To move a body takes
// 6 operations for a mass and 10 for an entry of the first moment; composite bodies are cheaper
// without masses. No more mass is moved than the robot has, lest round-off grow.
enum class Masses { kZero, kBalanced };
void regroup(const Context& context, Inertias& inertias, Masses masses);

}  // namespace sinew::synthesis
