// Operators of whole robots: the floating base, Jacobians, momentum, energy, the centre of mass,
// matrices that are put together from their parts.
#include "sinew/algorithm/operator_rows.h"

namespace sinew::algorithm {
namespace {

constexpr OperatorRow kRows[] = {
    // A floating base: the joint between the world and it has six degrees of freedom.
    {"position-to-pose-floating", SINEW_OWN "position-to-pose-floating",
     "position:floating-position -> pose:pose", "pose.of = position.of; pose.wrt = position.wrt",
     "X = [R(quaternion) p]"},
    {"velocity-to-twist-floating", SINEW_OWN "velocity-to-twist-floating",
     "velocity:floating-velocity -> twist:velocity-twist",
     "twist.of = velocity.of; twist.wrt = velocity.wrt; twist.at = velocity.seen", "V = qd"},
    {"acceleration-to-twist-floating", SINEW_OWN "acceleration-to-twist-floating",
     "acceleration:floating-acceleration velocity-twist:velocity-twist -> "
     "twist:acceleration-twist",
     "velocity-twist.of = acceleration.of; velocity-twist.wrt = acceleration.wrt; "
     "velocity-twist.at = acceleration.seen; twist.of = acceleration.of; "
     "twist.wrt = acceleration.wrt; twist.at = acceleration.seen",
     "A = qdd + (0, w x v)"},
    {"force-from-wrench-floating", SINEW_OWN "force-from-wrench-floating",
     "wrench:wrench -> force:floating-force", "wrench.of = force.of; wrench.at = force.seen",
     "f = W"},
    {"subtract-floating-force", SINEW_OWN "subtract-floating-force",
     "in1:floating-force in2:floating-force -> difference:floating-force",
     "in2.of = in1.of; in2.wrt = in1.wrt; in2.seen = in1.seen; difference.of = in1.of; "
     "difference.wrt = in1.wrt; difference.seen = in1.seen",
     "u = f_1 - f_2"},
    {"floating-acceleration-from-force", SINEW_OWN "floating-acceleration-from-force",
     "inertia:articulated-body-inertia force:floating-force -> acceleration:floating-acceleration",
     "inertia.of = force.of; inertia.at = force.seen; acceleration.of = force.of; "
     "acceleration.wrt = force.wrt; acceleration.seen = force.seen",
     "qdd = I^-1 u"},

    // The column of a geometric Jacobian: the twist of a point for one unit of joint velocity.
    {"jacobian-column-revolute", SINEW_OWN "jacobian-column-revolute",
     "joint-pose:pose point-pose:pose -> column:jacobian-column",
     "point-pose.wrt = joint-pose.wrt; column.seen = joint-pose.wrt; column.ref = point-pose.of; "
     "column.wrt = joint-pose.wrt; column.of = point-pose.of",
     "(z, z x (p_point - p_joint)), z the joint's axis"},
    {"jacobian-column-prismatic", SINEW_OWN "jacobian-column-prismatic",
     "joint-pose:pose point-pose:pose -> column:jacobian-column",
     "point-pose.wrt = joint-pose.wrt; column.seen = joint-pose.wrt; column.ref = point-pose.of; "
     "column.wrt = joint-pose.wrt; column.of = point-pose.of",
     "(0, z)"},
    {"jacobian-from-columns", SINEW_OWN "jacobian-from-columns",
     "columns*:jacobian-column -> jacobian:jacobian",
     "jacobian.of = columns.of; jacobian.wrt = columns.wrt; jacobian.at = columns.at",
     "6 x n, row by row"},

    // Momentum, energy, centre of mass.
    {"momentum-from-velocity-twist", SINEW_OWN "momentum-from-velocity-twist",
     "inertia:rigid-body-inertia velocity-twist:velocity-twist -> momentum:momentum",
     "velocity-twist.at = inertia.at; velocity-twist.of = inertia.of; momentum.at = inertia.at; "
     "momentum.of = inertia.of",
     "L = I w + h x v, p = m v + w x h"},
    {"transform-momentum-to-proximal", SINEW_OWN "transform-momentum-to-proximal",
     "pose:pose from:momentum -> to:momentum",
     "from.at = pose.of; to.at = pose.wrt; to.of = from.of", "p_A = R p_B, L_A = R L_B + p x p_A"},
    {"accumulate-momentum", SINEW_OWN "accumulate-momentum",
     "in1:momentum in2:momentum -> out:momentum",
     "in1.at = in2.at; out.at = in1.at; out.of = in1.of", "P = P_1 + P_2"},
    {"momentum-about-center-of-mass", SINEW_OWN "momentum-about-center-of-mass",
     "momentum:momentum center:position-vector -> about:momentum",
     "center.of = momentum.of; center.wrt = momentum.ref; center.seen = momentum.seen; "
     "about.of = momentum.of; about.ref = center.of; about.seen = momentum.seen",
     "L - c x p, p"},
    {"centroidal-momentum-column-revolute", SINEW_OWN "centroidal-momentum-column-revolute",
     "pose:pose inertia:rigid-body-inertia center:position-vector -> column:momentum-column",
     "inertia.at = pose.of; center.wrt = pose.wrt; center.seen = pose.wrt; column.ref = center.of; "
     "column.of = center.of; column.seen = pose.wrt",
     "(R I z + (p - c) x f, f) with f = R (z x h)"},
    {"centroidal-momentum-column-prismatic", SINEW_OWN "centroidal-momentum-column-prismatic",
     "pose:pose inertia:rigid-body-inertia center:position-vector -> column:momentum-column",
     "inertia.at = pose.of; center.wrt = pose.wrt; center.seen = pose.wrt; column.ref = center.of; "
     "column.of = center.of; column.seen = pose.wrt",
     "(R (h x z) + (p - c) x f, f) with f = m z"},
    {"centroidal-momentum-columns-floating", SINEW_OWN "centroidal-momentum-columns-floating",
     "pose:pose inertia:rigid-body-inertia center:position-vector -> columns:momentum-block",
     "inertia.at = pose.of; center.wrt = pose.wrt; center.seen = pose.wrt; "
     "columns.ref = center.of; columns.of = center.of; columns.seen = pose.wrt",
     "X I about c"},
    {"momentum-matrix-from-columns", SINEW_OWN "momentum-matrix-from-columns",
     "columns*:momentum-column -> matrix:momentum-matrix",
     "matrix.of = columns.of; matrix.at = columns.at", "6 x n, row by row"},
    {"floating-momentum-matrix-from-columns", SINEW_OWN "floating-momentum-matrix-from-columns",
     "base:momentum-block columns*:momentum-column -> matrix:momentum-matrix",
     "columns.of = base.of; columns.at = base.at; matrix.of = base.of; matrix.at = base.at",
     "6 x (6 + n), row by row"},
    {"kinetic-energy-from-momentum", SINEW_OWN "kinetic-energy-from-momentum",
     "velocity-twist:velocity-twist momentum:momentum -> energy:energy",
     "velocity-twist.at = momentum.at; velocity-twist.of = momentum.of", "T = (w . L + v . p) / 2"},
    {"add-energy", SINEW_OWN "add-energy", "in1:energy in2:energy -> sum:energy", "", "E_1 + E_2"},
    {"potential-energy-from-rigid-body-inertia",
     SINEW_OWN "potential-energy-from-rigid-body-inertia",
     "inertia:rigid-body-inertia base-acceleration:acceleration-twist -> energy:energy",
     "base-acceleration.at = inertia.at; base-acceleration.of = inertia.of", "E = a . h = -g . h"},
    {"center-of-mass-from-rigid-body-inertia", SINEW_OWN "center-of-mass-from-rigid-body-inertia",
     "inertia:rigid-body-inertia -> position:position-vector",
     "position.of = inertia.of; position.wrt = inertia.ref; position.seen = inertia.seen", "h / m"},
    {"center-of-mass-velocity-from-momentum", SINEW_OWN "center-of-mass-velocity-from-momentum",
     "inertia:rigid-body-inertia momentum:momentum -> velocity:linear-velocity",
     "momentum.at = inertia.at; momentum.of = inertia.of; velocity.of = inertia.of; "
     "velocity.wrt = inertia.ref; velocity.seen = inertia.seen",
     "p / m"},
    {"center-of-mass-column-revolute", SINEW_OWN "center-of-mass-column-revolute",
     "pose:pose inertia:rigid-body-inertia total:rigid-body-inertia -> "
     "column:linear-jacobian-column",
     "inertia.at = pose.of; total.at = pose.wrt; column.of = total.of; column.wrt = pose.wrt; "
     "column.seen = pose.wrt",
     "R (z x h) / m_total"},
    {"center-of-mass-column-prismatic", SINEW_OWN "center-of-mass-column-prismatic",
     "pose:pose inertia:rigid-body-inertia total:rigid-body-inertia -> "
     "column:linear-jacobian-column",
     "inertia.at = pose.of; total.at = pose.wrt; column.of = total.of; column.wrt = pose.wrt; "
     "column.seen = pose.wrt",
     "z m / m_total"},
    {"center-of-mass-columns-floating", SINEW_OWN "center-of-mass-columns-floating",
     "pose:pose inertia:rigid-body-inertia total:rigid-body-inertia -> "
     "columns:linear-jacobian-block",
     "inertia.at = pose.of; total.at = pose.wrt; columns.of = total.of; columns.wrt = pose.wrt; "
     "columns.seen = pose.wrt",
     "(-R [h]x, R m) / m_total"},
    {"linear-jacobian-from-columns", SINEW_OWN "linear-jacobian-from-columns",
     "columns*:linear-jacobian-column -> jacobian:linear-jacobian",
     "jacobian.of = columns.of; jacobian.wrt = columns.wrt; jacobian.seen = columns.seen",
     "3 x n, row by row"},
    {"floating-linear-jacobian-from-columns", SINEW_OWN "floating-linear-jacobian-from-columns",
     "base:linear-jacobian-block columns*:linear-jacobian-column -> jacobian:linear-jacobian",
     "columns.of = base.of; columns.wrt = base.wrt; columns.seen = base.seen; "
     "jacobian.of = base.of; jacobian.wrt = base.wrt; jacobian.seen = base.seen",
     "3 x (6 + n), row by row"},
    {"jacobian-columns-floating", SINEW_OWN "jacobian-columns-floating",
     "joint-pose:pose point-pose:pose -> columns:jacobian-block",
     "point-pose.wrt = joint-pose.wrt; columns.seen = joint-pose.wrt; columns.ref = point-pose.of; "
     "columns.wrt = joint-pose.wrt; columns.of = point-pose.of",
     "(R, -[p_point - p_joint]x R; 0, R)"},
    {"floating-jacobian-from-columns", SINEW_OWN "floating-jacobian-from-columns",
     "base:jacobian-block columns*:jacobian-column -> jacobian:jacobian",
     "columns.of = base.of; columns.wrt = base.wrt; columns.at = base.at; jacobian.of = base.of; "
     "jacobian.wrt = base.wrt; jacobian.at = base.at",
     "6 x (6 + n), row by row"},
    {"mass-matrix-from-entries", SINEW_OWN "mass-matrix-from-entries",
     "entries*:joint-force -> mass-matrix:mass-matrix", "", "n x n, row by row"},
    {"floating-mass-matrix-from-parts", SINEW_OWN "floating-mass-matrix-from-parts",
     "inertia:rigid-body-inertia base-wrenches*:wrench entries*:joint-force -> "
     "mass-matrix:mass-matrix",
     "base-wrenches.at = inertia.at", "(6 + n) x (6 + n), row by row"},
};

}  // namespace

std::span<const OperatorRow> whole_operator_rows() { return kRows; }

}  // namespace sinew::algorithm
