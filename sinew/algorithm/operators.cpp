#include "sinew/algorithm/operators.h"

#include <cctype>
#include <stdexcept>
#include <unordered_map>

#include "sinew/algorithm/operator_rows.h"
#include "sinew/data/units.h"

namespace sinew::algorithm {
namespace {

#define SINEW_PUBLISHED "https://comp-rob2b.github.io/metamodels/"
#define SINEW_GEOMETRY SINEW_PUBLISHED "geometry/spatial-operators#"
#define SINEW_DYNAMICS SINEW_PUBLISHED "newtonian-rigid-body-dynamics/operators#"

using Row = OperatorRow;

constexpr Row kRows[] = {
    // Joint space to Cartesian space. The joint's axis is z of its two frames.
    {"position-to-pose-revolute", SINEW_OWN "position-to-pose-revolute",
     "position:joint-position -> pose:pose", "pose.of = position.of; pose.wrt = position.wrt",
     "X = [Rz(q) 0]"},
    {"position-to-pose-prismatic", SINEW_OWN "position-to-pose-prismatic",
     "position:joint-position -> pose:pose", "pose.of = position.of; pose.wrt = position.wrt",
     "X = [1 (0 0 q)]"},
    {"velocity-to-twist-revolute", SINEW_OWN "velocity-to-twist-revolute",
     "velocity:joint-velocity -> twist:velocity-twist",
     "twist.of = velocity.of; twist.wrt = velocity.wrt; twist.at = velocity.seen",
     "V = (0 0 qd, 0 0 0)"},
    {"velocity-to-twist-prismatic", SINEW_OWN "velocity-to-twist-prismatic",
     "velocity:joint-velocity -> twist:velocity-twist",
     "twist.of = velocity.of; twist.wrt = velocity.wrt; twist.at = velocity.seen",
     "V = (0 0 0, 0 0 qd)"},
    {"acceleration-to-twist-revolute", SINEW_OWN "acceleration-to-twist-revolute",
     "acceleration:joint-acceleration -> twist:acceleration-twist",
     "twist.of = acceleration.of; twist.wrt = acceleration.wrt; twist.at = acceleration.seen",
     "A = (0 0 qdd, 0 0 0)"},
    {"acceleration-to-twist-prismatic", SINEW_OWN "acceleration-to-twist-prismatic",
     "acceleration:joint-acceleration -> twist:acceleration-twist",
     "twist.of = acceleration.of; twist.wrt = acceleration.wrt; twist.at = acceleration.seen",
     "A = (0 0 0, 0 0 qdd)"},
    {"force-from-wrench-revolute", SINEW_OWN "force-from-wrench-revolute",
     "wrench:wrench -> force:joint-force", "wrench.of = force.of; wrench.at = force.seen",
     "tau = nz"},
    {"force-from-wrench-prismatic", SINEW_OWN "force-from-wrench-prismatic",
     "wrench:wrench -> force:joint-force", "wrench.of = force.of; wrench.at = force.seen",
     "tau = fz"},

    // Poses. X_AB is the pose of B with respect to A: p_A = R p_B + p.
    {"compose-pose", SINEW_GEOMETRY "ComposePose", "in1:pose in2:pose -> composite:pose",
     "in1.of = in2.wrt; composite.wrt = in1.wrt; composite.of = in2.of", "X_AD = X_AB X_BD"},
    {"invert-pose", SINEW_OWN "invert-pose", "pose:pose -> inverse:pose",
     "inverse.of = pose.wrt; inverse.wrt = pose.of", "X_BA = X_AB^-1"},

    // Velocity twists.
    {"transform-velocity-twist-to-distal", SINEW_GEOMETRY "TransformVelocityTwistToDistal",
     "pose:pose from:velocity-twist -> to:velocity-twist",
     "from.at = pose.wrt; to.at = pose.of; to.of = from.of; to.wrt = from.wrt",
     "w_B = R' w_A, v_B = R' (v_A + w_A x p)"},
    {"add-velocity-twist", SINEW_GEOMETRY "AddVelocityTwist",
     "in1:velocity-twist in2:velocity-twist -> composite:velocity-twist",
     "in1.of = in2.wrt; composite.wrt = in1.wrt; composite.of = in2.of; in1.at = in2.at; "
     "composite.at = in1.at",
     "V_RC = V_RP + V_PC"},
    // Rotations change the directions and leave the reference point.
    {"rotate-velocity-twist-to-proximal", SINEW_GEOMETRY "RotateVelocityTwistToProximalWithPose",
     "pose:pose from:velocity-twist -> to:velocity-twist",
     "from.seen = pose.of; to.seen = pose.wrt; to.ref = from.ref; to.of = from.of; "
     "to.wrt = from.wrt",
     "w_A = R w_B, v_A = R v_B"},
    {"rotate-velocity-twist-to-distal", SINEW_OWN "rotate-velocity-twist-to-distal",
     "pose:pose from:velocity-twist -> to:velocity-twist",
     "from.seen = pose.wrt; to.seen = pose.of; to.ref = from.ref; to.of = from.of; "
     "to.wrt = from.wrt",
     "w_B = R' w_A, v_B = R' v_A"},

    // Classical acceleration twists: the derivative of angular velocity, and the acceleration of a
    // point.
    // `in` and `out` are the acceleration of P; `out` at the origin of B as it moves with C, so
    // that adding
    // the relative acceleration of C gives the acceleration of C.
    {"transform-acceleration-twist-to-distal", SINEW_GEOMETRY "TransformAccelerationTwistToDistal",
     "pose:pose absolute-velocity:velocity-twist relative-velocity:velocity-twist "
     "in:acceleration-twist -> out:acceleration-twist",
     "in.at = pose.wrt; absolute-velocity.at = pose.wrt; relative-velocity.at = pose.of; "
     "out.at = pose.of; in.of = absolute-velocity.of; in.wrt = absolute-velocity.wrt; "
     "relative-velocity.wrt = absolute-velocity.of; out.of = in.of; out.wrt = in.wrt",
     "al_B = R' al_A + (R' w_A) x w_rel, "
     "a_B = R' (a_A + al_A x p + w_A x (w_A x p)) + 2 (R' w_A) x v_rel"},
    // The same between two frames of one body.
    {"transform-acceleration-twist-to-distal-fixed",
     SINEW_OWN "transform-acceleration-twist-to-distal-fixed",
     "pose:pose absolute-velocity:velocity-twist in:acceleration-twist -> out:acceleration-twist",
     "in.at = pose.wrt; absolute-velocity.at = pose.wrt; out.at = pose.of; "
     "in.of = absolute-velocity.of; in.wrt = absolute-velocity.wrt; out.of = in.of; out.wrt = "
     "in.wrt",
     "al_B = R' al_A, a_B = R' (a_A + al_A x p + w_A x (w_A x p))"},
    // Between two frames of a robot that is held still: no velocities, no relative motion.
    {"transform-acceleration-twist-to-distal-at-rest",
     SINEW_OWN "transform-acceleration-twist-to-distal-at-rest",
     "pose:pose in:acceleration-twist -> out:acceleration-twist",
     "in.at = pose.wrt; out.at = pose.of; out.of = in.of; out.wrt = in.wrt",
     "al_B = R' al_A, a_B = R' (a_A + al_A x p)"},
    {"add-acceleration-twist", SINEW_GEOMETRY "AddAccelerationTwist",
     "in1:acceleration-twist in2:acceleration-twist -> composite:acceleration-twist",
     "in1.of = in2.wrt; composite.wrt = in1.wrt; composite.of = in2.of; in1.at = in2.at; "
     "composite.at = in1.at",
     "A_RC = A_RP + A_PC"},
    {"rotate-acceleration-twist-to-proximal", SINEW_OWN "rotate-acceleration-twist-to-proximal",
     "pose:pose from:acceleration-twist -> to:acceleration-twist",
     "from.seen = pose.of; to.seen = pose.wrt; to.ref = from.ref; to.of = from.of; "
     "to.wrt = from.wrt",
     "al_A = R al_B, a_A = R a_B"},
    {"rotate-acceleration-twist-to-distal", SINEW_OWN "rotate-acceleration-twist-to-distal",
     "pose:pose from:acceleration-twist -> to:acceleration-twist",
     "from.seen = pose.wrt; to.seen = pose.of; to.ref = from.ref; to.of = from.of; "
     "to.wrt = from.wrt",
     "al_B = R' al_A, a_B = R' a_A"},

    // Gravity that varies. Seen from what falls freely, the base accelerates against it.
    {"base-acceleration-from-gravity", SINEW_OWN "base-acceleration-from-gravity",
     "gravity:linear-acceleration -> acceleration:acceleration-twist",
     "acceleration.of = gravity.wrt; acceleration.wrt = gravity.of; "
     "acceleration.at = gravity.seen",
     "A = (0, -g)"},
    {"free-fall-from-gravity", SINEW_OWN "free-fall-from-gravity",
     "pose:pose gravity:linear-acceleration -> acceleration:acceleration-twist",
     "gravity.seen = pose.wrt; acceleration.of = gravity.of; acceleration.wrt = gravity.wrt; "
     "acceleration.seen = gravity.seen; acceleration.ref = pose.of",
     "A = (0, g), about the origin of the pose's frame"},

    // Wrenches: what moves a body as it moves, and what a joint must transmit.
    {"newton-euler-wrench", SINEW_OWN "newton-euler-wrench",
     "rigid-body-inertia:rigid-body-inertia velocity-twist:velocity-twist "
     "acceleration-twist:acceleration-twist -> wrench:wrench",
     "velocity-twist.at = rigid-body-inertia.at; acceleration-twist.at = rigid-body-inertia.at; "
     "wrench.at = rigid-body-inertia.at; velocity-twist.of = rigid-body-inertia.of; "
     "acceleration-twist.of = rigid-body-inertia.of; wrench.of = rigid-body-inertia.of; "
     "acceleration-twist.wrt = velocity-twist.wrt",
     "n = I al + w x (I w) + h x a, f = m a + al x h + w x (w x h)"},
    // The same, seen from the frame before the body's joint, from how the predecessor moves there.
    {"newton-euler-wrench-across-revolute", SINEW_OWN "newton-euler-wrench-across-revolute",
     "pose:pose rigid-body-inertia:rigid-body-inertia velocity-twist:velocity-twist "
     "relative-velocity:velocity-twist acceleration-twist:acceleration-twist "
     "relative-acceleration:acceleration-twist -> wrench:wrench",
     "rigid-body-inertia.at = pose.of; velocity-twist.at = pose.wrt; "
     "acceleration-twist.at = pose.wrt; relative-velocity.at = pose.of; "
     "relative-acceleration.at = pose.of; acceleration-twist.of = velocity-twist.of; "
     "acceleration-twist.wrt = velocity-twist.wrt; relative-velocity.wrt = velocity-twist.of; "
     "relative-acceleration.wrt = velocity-twist.of; "
     "relative-velocity.of = rigid-body-inertia.of; "
     "relative-acceleration.of = rigid-body-inertia.of; wrench.at = pose.wrt; "
     "wrench.of = rigid-body-inertia.of",
     "with w = w_A + q' z, al = al_A + q'' z + w_A x q' z, h = R h_B, I = R I_B R': "
     "n = I al + w x (I w) + h x a_A, f = m a_A + al x h + w x (w x h)"},
    // The same for a body at rest.
    {"acceleration-twist-to-wrench", SINEW_DYNAMICS "AccelerationTwistToWrenchWithRigidBodyInertia",
     "rigid-body-inertia:rigid-body-inertia acceleration-twist:acceleration-twist -> wrench:wrench",
     "acceleration-twist.at = rigid-body-inertia.at; wrench.at = rigid-body-inertia.at; "
     "acceleration-twist.of = rigid-body-inertia.of; wrench.of = rigid-body-inertia.of",
     "n = I al + h x a, f = m a + al x h"},
    {"acceleration-twist-to-wrench-across-revolute",
     SINEW_OWN "acceleration-twist-to-wrench-across-revolute",
     "pose:pose rigid-body-inertia:rigid-body-inertia acceleration-twist:acceleration-twist "
     "relative-acceleration:acceleration-twist -> wrench:wrench",
     "rigid-body-inertia.at = pose.of; acceleration-twist.at = pose.wrt; "
     "relative-acceleration.at = pose.of; "
     "relative-acceleration.wrt = acceleration-twist.of; "
     "relative-acceleration.of = rigid-body-inertia.of; wrench.at = pose.wrt; "
     "wrench.of = rigid-body-inertia.of",
     "with al = al_A + q'' z, h = R h_B, I = R I_B R': n = I al + h x a_A, f = m a_A + al x h"},
    {"transform-wrench-to-proximal", SINEW_DYNAMICS "TransformWrenchToProximal",
     "pose:pose from:wrench -> to:wrench", "from.at = pose.of; to.at = pose.wrt; to.of = from.of",
     "f_A = R f_B, n_A = R n_B + p x f_A"},
    {"rotate-wrench-to-proximal", SINEW_DYNAMICS "RotateWrenchToProximalWithPose",
     "pose:pose from:wrench -> to:wrench",
     "from.seen = pose.of; to.seen = pose.wrt; to.ref = from.ref; to.of = from.of",
     "f_A = R f_B, n_A = R n_B"},
    {"rotate-wrench-to-distal", SINEW_DYNAMICS "RotateWrenchToDistalWithPose",
     "pose:pose from:wrench -> to:wrench",
     "from.seen = pose.wrt; to.seen = pose.of; to.ref = from.ref; to.of = from.of",
     "f_B = R' f_A, n_B = R' n_A"},
    // A body's own wrench and that which a successor hands on to it.
    {"accumulate-wrench", SINEW_DYNAMICS "AddWrench", "in1:wrench in2:wrench -> out:wrench",
     "in1.at = in2.at; out.at = in1.at; out.of = in1.of", "W = W_1 + W_2"},

    // Inertias of several bodies, and the wrench that one unit of joint acceleration takes: the
    // columns from
    // which the mass matrix and the articulated-body algorithm are made. A force for one unit of
    // acceleration is a joint-force.
    {"transform-rigid-body-inertia-to-proximal",
     SINEW_OWN "transform-rigid-body-inertia-to-proximal",
     "pose:pose from:rigid-body-inertia -> to:rigid-body-inertia",
     "from.at = pose.of; to.at = pose.wrt; to.of = from.of",
     "h_A = R h_B + m p, I_A = R I_B R' and Steiner's theorem"},
    {"accumulate-rigid-body-inertia", SINEW_OWN "accumulate-rigid-body-inertia",
     "in1:rigid-body-inertia in2:rigid-body-inertia -> out:rigid-body-inertia",
     "in1.at = in2.at; out.at = in1.at; out.of = in1.of", "I = I_1 + I_2"},
    {"wrench-of-revolute-from-rigid-body-inertia",
     SINEW_OWN "wrench-of-revolute-from-rigid-body-inertia",
     "inertia:rigid-body-inertia -> wrench:wrench",
     "wrench.at = inertia.at; wrench.of = inertia.of", "W = I (0 0 1, 0 0 0)"},
    {"wrench-of-prismatic-from-rigid-body-inertia",
     SINEW_OWN "wrench-of-prismatic-from-rigid-body-inertia",
     "inertia:rigid-body-inertia -> wrench:wrench",
     "wrench.at = inertia.at; wrench.of = inertia.of", "W = I (0 0 0, 0 0 1)"},
    {"articulated-from-rigid-body-inertia", SINEW_OWN "articulated-from-rigid-body-inertia",
     "inertia:rigid-body-inertia -> articulated:articulated-body-inertia",
     "articulated.at = inertia.at; articulated.of = inertia.of", "J = I, H = [h]x, M = m 1"},
    {"accumulate-articulated-body-inertia", SINEW_OWN "accumulate-articulated-body-inertia",
     "in1:articulated-body-inertia in2:articulated-body-inertia -> out:articulated-body-inertia",
     "in1.at = in2.at; out.at = in1.at; out.of = in1.of", "I = I_1 + I_2"},
    {"transform-articulated-body-inertia-to-proximal",
     SINEW_OWN "transform-articulated-body-inertia-to-proximal",
     "pose:pose from:articulated-body-inertia -> to:articulated-body-inertia",
     "from.at = pose.of; to.at = pose.wrt; to.of = from.of", "I_A = X^-T I_B X^-1"},
    {"wrench-of-revolute-from-articulated-body-inertia",
     SINEW_OWN "wrench-of-revolute-from-articulated-body-inertia",
     "inertia:articulated-body-inertia -> wrench:wrench",
     "wrench.at = inertia.at; wrench.of = inertia.of", "U = I (0 0 1, 0 0 0)"},
    {"wrench-of-prismatic-from-articulated-body-inertia",
     SINEW_OWN "wrench-of-prismatic-from-articulated-body-inertia",
     "inertia:articulated-body-inertia -> wrench:wrench",
     "wrench.at = inertia.at; wrench.of = inertia.of", "U = I (0 0 0, 0 0 1)"},
    // What the predecessor feels of a body behind a joint that is free to move.
    {"project-articulated-body-inertia", SINEW_OWN "project-articulated-body-inertia",
     "inertia:articulated-body-inertia unit-wrench:wrench unit-force:joint-force -> "
     "projected:articulated-body-inertia",
     "unit-wrench.at = inertia.at; projected.at = inertia.at; unit-wrench.of = inertia.of; "
     "projected.of = inertia.of; unit-force.of = inertia.of; unit-force.seen = inertia.seen",
     "I - U U' / D"},
    // The joint's frames before and behind it have the axis in common, about which its force is.
    {"project-wrench", SINEW_OWN "project-wrench",
     "wrench:wrench unit-wrench:wrench unit-force:joint-force force:joint-force -> "
     "projected:wrench",
     "unit-wrench.at = wrench.at; projected.at = wrench.at; unit-wrench.of = wrench.of; "
     "projected.of = wrench.of; unit-force.of = wrench.of; force.of = wrench.of; "
     "unit-force.seen = force.seen",
     "W + U u / D"},
    {"joint-acceleration-from-force", SINEW_OWN "joint-acceleration-from-force",
     "force:joint-force unit-wrench:wrench unit-force:joint-force "
     "acceleration-twist:acceleration-twist -> acceleration:joint-acceleration",
     "unit-wrench.of = force.of; unit-force.of = force.of; "
     "unit-force.seen = force.seen; acceleration-twist.at = unit-wrench.at; "
     "acceleration-twist.of = force.wrt; acceleration.of = force.of; acceleration.wrt = force.wrt; "
     "acceleration.seen = force.seen",
     "qdd = (u - U . A) / D"},
    {"subtract-joint-force", SINEW_OWN "subtract-joint-force",
     "in1:joint-force in2:joint-force -> difference:joint-force",
     "in2.of = in1.of; in2.wrt = in1.wrt; in2.seen = in1.seen; difference.of = in1.of; "
     "difference.wrt = in1.wrt; difference.seen = in1.seen",
     "u = tau_1 - tau_2"},

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

// External operators. What `read` writes are inputs of the algorithm: it stands for the caller. The
// others write nothing.
constexpr Row kExternalRows[] = {
    {"read", SINEW_OWN "read", "-> quantity*:any", "", "measurements of the robot sa:interface"},
    {"write", SINEW_OWN "write", "quantity*:any ->", "", "commands to the robot sa:interface"},
    {"log", SINEW_OWN "log", "quantity*:any ->", "", "one row for the recorder, under sa:label"},
    {"check-range", SINEW_OWN "check-range", "quantity*:any ->", "",
     "sa:lower <= every number <= sa:upper; otherwise sa:action"},
    {"check-flag", SINEW_OWN "check-flag", "quantity*:any ->", "",
     "every number is 0; otherwise sa:action"},
    {"probe-time", SINEW_OWN "probe-time", "", "", "how long into the cycle, under sa:label"},
};

[[noreturn]] void fault(const Row& row, std::string_view what) {
  throw std::logic_error("operator catalogue, row " + std::string(row.name) + ": " +
                         std::string(what));
}

// Takes the text before the next `separator` (or the rest) off the front of `text`.
std::string_view take(std::string_view& text, std::string_view separator) {
  const std::size_t at = text.find(separator);
  const std::string_view head = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view{} : text.substr(at + separator.size());
  return head;
}

void parse_ports(const Row& row, Operator& op) {
  const std::string space = op.iri.substr(0, op.iri.find('#') + 1);
  Direction direction = Direction::kIn;
  for (std::string_view rest = row.ports; !rest.empty();) {
    const std::string_view word = take(rest, " ");
    if (word == "->") {
      direction = Direction::kOut;
      continue;
    }
    std::string_view quantity = word;
    std::string_view name = take(quantity, ":");
    const bool many = name.ends_with('*');
    if (many) name.remove_suffix(1);
    if (find_quantity(quantity) == nullptr && !(op.external && quantity == kAnyQuantity))
      fault(row, "unknown quantity");
    op.ports.push_back(
        {std::string(name), space + std::string(name), std::string(quantity), direction, many});
  }
}

std::uint8_t port_index(const Row& row, const Operator& op, std::string_view name) {
  for (std::size_t i = 0; i < op.ports.size(); ++i)
    if (op.ports[i].name == name) return static_cast<std::uint8_t>(i);
  fault(row, "a rule names a port that does not exist");
}

Attribute parse_attribute(const Row& row, std::string_view text) {
  if (text == "of") return Attribute::kOf;
  if (text == "wrt") return Attribute::kWrt;
  if (text == "ref") return Attribute::kReference;
  if (text == "seen") return Attribute::kSeenBy;
  fault(row, "a rule names a symbol that does not exist");
}

void parse_rules(const Row& row, Operator& op) {
  for (std::string_view rest = row.rules; !rest.empty();) {
    std::string_view right = take(rest, "; ");
    std::string_view left = take(right, " = ");
    const std::uint8_t left_port = port_index(row, op, take(left, "."));
    const std::uint8_t right_port = port_index(row, op, take(right, "."));
    if (left != "at") {
      op.rules.push_back(
          {{left_port, parse_attribute(row, left)}, {right_port, parse_attribute(row, right)}});
      continue;
    }
    for (const Attribute attribute : {Attribute::kSeenBy, Attribute::kReference})
      op.rules.push_back({{left_port, attribute},
                          {right_port, right == "at" ? attribute : parse_attribute(row, right)}});
  }
}

// "control = proportional-gain error": what is right of the sign, divided by what is left of it,
// has no dimension.
void parse_units(const Row& row, Operator& op) {
  for (std::string_view rest = row.units; !rest.empty();) {
    std::string_view right = take(rest, "; ");
    UnitRule rule{std::string(right), {}, {}};
    bool left = true;
    while (!right.empty()) {
      const std::string_view word = take(right, " ");
      if (word == "=") {
        left = false;
      } else if (std::isupper(static_cast<unsigned char>(word.front()))) {
        const auto unit = data::find_unit(word);
        if (!unit) fault(row, "a rule names a unit that does not exist");
        rule.rest = left ? rule.rest / unit->dimension : rule.rest * unit->dimension;
      } else if (word != "1") {
        rule.factors.push_back(
            {port_index(row, op, word), static_cast<std::int8_t>(left ? -1 : 1)});
      }
    }
    op.unit_rules.push_back(std::move(rule));
  }
}

struct Catalogue {
  std::vector<Operator> all;
  std::unordered_map<std::string_view, const Operator*> by_name, by_iri;

  Catalogue() {
    const std::span<const Row> control = control_operator_rows();
    const std::span<const Row> relative = relative_operator_rows();
    const std::span<const Row> joints = joint_operator_rows();
    const std::span<const Row> hybrid = hybrid_operator_rows();
    all.reserve(std::size(kRows) + control.size() + relative.size() + joints.size() +
                hybrid.size() + std::size(kExternalRows));
    for (const Row& row : kRows) add(row, false);
    for (const Row& row : control) add(row, false);
    for (const Row& row : relative) add(row, false);
    for (const Row& row : joints) add(row, false);
    for (const Row& row : hybrid) add(row, false);
    for (const Row& row : kExternalRows) add(row, true);
    for (const Operator& op : all) {
      if (!by_name.emplace(op.name, &op).second || !by_iri.emplace(op.iri, &op).second)
        throw std::logic_error("operator catalogue: two rows for " + std::string(op.name));
    }
  }

  void add(const Row& row, bool external) {
    Operator& op = all.emplace_back(
        Operator{row.name, std::string(row.iri), row.formula, {}, {}, {}, external});
    parse_ports(row, op);
    parse_rules(row, op);
    parse_units(row, op);
  }
};

const Catalogue& catalogue() {
  static const Catalogue instance;
  return instance;
}

const Operator* find(const std::unordered_map<std::string_view, const Operator*>& map,
                     std::string_view key) {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : found->second;
}

std::string to_string(Symbol symbol, const Operator& op) {
  return op.ports[symbol.port].name + "." + std::string(to_string(symbol.attribute));
}

}  // namespace

std::span<const Operator> operators() { return catalogue().all; }
const Operator* find_operator(std::string_view name) { return find(catalogue().by_name, name); }
const Operator* find_operator_by_iri(std::string_view iri) { return find(catalogue().by_iri, iri); }

std::string to_string(const FrameRule& rule, const Operator& op) {
  return to_string(rule.left, op) + " = " + to_string(rule.right, op);
}

}  // namespace sinew::algorithm
