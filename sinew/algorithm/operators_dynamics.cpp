// Operators of forces and of what resists them: wrenches, rigid-body, composite and articulated
// inertias, joints that give way.
#include "sinew/algorithm/operator_rows.h"

namespace sinew::algorithm {
namespace {

constexpr OperatorRow kRows[] = {
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
    // columns from which the mass matrix and the articulated-body algorithm are made. A force for
    // one unit of acceleration is a joint-force.
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
};

}  // namespace

std::span<const OperatorRow> dynamics_operator_rows() { return kRows; }

}  // namespace sinew::algorithm
