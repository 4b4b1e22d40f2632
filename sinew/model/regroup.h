// Base inertial parameters: moves from each body to its predecessor what moves with both alike, so
// that fewer numbers are left and joint forces stay the same (Khalil and Dombre 2002, section 9.4).
//
// A revolute joint's body gives away the part of it that lies on the axis, as if along a thin rod:
// its mass, its first moment h_z and its second moment S_zz = (Ixx + Iyy - Izz) / 2. Turning a rod
// about itself takes no torque, and its motion is that of the predecessor. A prismatic joint's body
// gives away its rotational inertia, because it turns as its predecessor does.
//
// Joint forces, mass matrices and forward dynamics of the joints are unchanged, for a fixed base
// and for a floating one. Wrenches on links, energies and centres of mass are not: do this only for
// a query that does not ask for them.
#pragma once

#include "sinew/model/tree.h"

namespace sinew::model {

// Bodies keep `has_inertia`; one that has given away everything has an inertia of zeros.
void regroup_inertial_parameters(Tree& tree);

}  // namespace sinew::model
