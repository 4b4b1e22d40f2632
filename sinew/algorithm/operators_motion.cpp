// Operators of motion: from joint space to Cartesian space, poses, velocity and acceleration
// twists, gravity.
#include "sinew/algorithm/operator_rows.h"

namespace sinew::algorithm {
namespace {

constexpr OperatorRow kRows[] = {
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
    // point. `in` and `out` are the acceleration of P; `out` at the origin of B as it moves with C,
    // so that adding the relative acceleration of C gives the acceleration of C.
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
};

}  // namespace

std::span<const OperatorRow> motion_operator_rows() { return kRows; }

}  // namespace sinew::algorithm
