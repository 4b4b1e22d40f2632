// Rotations and constants of a model: making them, checking them, and clearing them of the dust
// that computing with rounded numbers leaves.
#pragma once

#include "sinew/model/tree.h"

namespace sinew::model {

// Direction cosines closer than this to 0, 1 or -1 are exactly that: what pi leaves behind that was
// written with twelve digits, or computed. (1.5708 is not pi/2 and stays what it is.)
constexpr double kSnapTolerance = 1e-12;
// The same for lengths (of a metre or, if the whole tree is smaller, of its longest) and, as a
// share of the largest of their kind, parts of an inertia: what some frames composed leave behind,
// and no number that somebody wrote. (A light floating base turns 1e-13 of an inertia into 1e-8 of
// an acceleration.)
constexpr double kLengthTolerance = 1e-14;
// The same for the sine and cosine of an angle that was read: what rounding pi/2 to a double
// leaves.
constexpr double kAngleTolerance = 1e-15;

// How far a stated rotation's columns may be from orthonormal: up to the first, it is taken as it
// is; up to the second, made orthonormal in silence; up to the third, with a warning; beyond, it is
// refused. The third is the tolerance of the published shapes.
constexpr double kOrthonormalRoundOff = 1e-12;
constexpr double kOrthonormalWarning = 1e-6;
constexpr double kOrthonormalError = 1e-3;

Matrix3 identity_rotation();
Pose identity_pose();
// Exactly: beside entries of 1 there is room for others of up to 1e-8, a tilt.
bool is_identity(const Matrix3& R);
bool is_identity(const Pose& X);

// About z by an angle; about fixed axes x, then y, then z (URDF's roll, pitch, yaw).
Matrix3 rotation_about_z(double angle);
Matrix3 rotation_from_rpy(double roll, double pitch, double yaw);
// A rotation whose z is the given unit vector, with the fewest entries that are neither 0 nor 1 nor
// -1.
Matrix3 rotation_with_z(const Vector3& axis);

// The largest entry of |R^T R - 1|, or 2 when R is a reflection.
double orthonormality_error(const Matrix3& R);
// The rotation nearest to R (polar decomposition). Precondition: orthonormality_error < 0.1.
Matrix3 nearest_rotation(const Matrix3& R);

double snap(double value, double tolerance);
void snap(Matrix3& R, double tolerance);
// Positions snap to 0 only.
void snap(Pose& X, double tolerance, double length_tolerance);

}  // namespace sinew::model
