// Rigid-body inertias as numbers: seeing them from other frames, adding them, and whether a real
// body can have them.
#pragma once

#include "sinew/model/tree.h"

namespace sinew::model {

// The inertia I, about a point P and seen from axes S, about the origin of F and seen from F:
// R_FS turns S into F, and p_FP is P seen from F.
RigidBodyInertia transformed(const RigidBodyInertia& I, const Matrix3& R_FS, const Vector3& p_FP);
// About the centre of mass. Precondition: mass > 0.
RigidBodyInertia about_centre_of_mass(const RigidBodyInertia& I);

RigidBodyInertia operator+(const RigidBodyInertia& a, const RigidBodyInertia& b);

// Clears entries that are dust next to the others: moments below `tolerance` of the largest, and a
// centre of mass closer than `length_tolerance` to an axis.
void snap(RigidBodyInertia& I, double tolerance, double length_tolerance);

// The eigenvalues of a symmetric matrix, in ascending order.
Vector3 eigenvalues(const math::Symmetric3<double>& S);

}  // namespace sinew::model
