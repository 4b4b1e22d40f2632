// Operators of motion between two frames that both move, and of coordinates of rotation. Their
// functions are in math/relative_motion.h.
#include "sinew/algorithm/operator_rows.h"

namespace sinew::algorithm {
namespace {

#define SINEW_SAME_TWIST(PORT) \
  PORT ".of = twist.of; " PORT ".wrt = twist.wrt; " PORT ".at = twist.at"

constexpr OperatorRow kRows[] = {
    // Both with respect to the same third; the second as it would be at the first's frame.
    {"subtract-velocity-twist", SINEW_OWN "subtract-velocity-twist",
     "in1:velocity-twist in2:velocity-twist -> difference:velocity-twist",
     "in1.wrt = in2.wrt; in1.at = in2.at; difference.of = in1.of; difference.wrt = in2.of; "
     "difference.at = in1.at",
     "V_FG = V_F - V_G"},
    {"subtract-acceleration-twist", SINEW_OWN "subtract-acceleration-twist",
     "in1:acceleration-twist in2:acceleration-twist -> difference:acceleration-twist",
     "in1.wrt = in2.wrt; in1.at = in2.at; difference.of = in1.of; difference.wrt = in2.of; "
     "difference.at = in1.at",
     "A_FG = A_F - A_G"},
    {"spatial-acceleration-from-classical", SINEW_OWN "spatial-acceleration-from-classical",
     "acceleration:acceleration-twist twist:velocity-twist -> spatial:spatial-acceleration-twist",
     SINEW_SAME_TWIST("acceleration") "; " SINEW_SAME_TWIST("spatial"), "a - w x v"},
    {"derivative-seen-by-observer", SINEW_OWN "derivative-seen-by-observer",
     "acceleration:acceleration-twist twist:velocity-twist observer:velocity-twist -> "
     "derivative:acceleration-twist",
     SINEW_SAME_TWIST("acceleration") "; " SINEW_SAME_TWIST(
         "derivative") "; "
                       "observer.wrt = twist.wrt; observer.seen = twist.seen",
     "A - w_observer x V"},
    {"rotate-spatial-acceleration-twist-to-proximal",
     SINEW_OWN "rotate-spatial-acceleration-twist-to-proximal",
     "pose:pose from:spatial-acceleration-twist -> to:spatial-acceleration-twist",
     "from.seen = pose.of; to.seen = pose.wrt; to.ref = from.ref; to.of = from.of; "
     "to.wrt = from.wrt",
     "al_A = R al_B, a_A = R a_B"},

    // A twist by way of its Jacobian, where how the body turns is known already: the first has no
    // linear
    // part yet, the second adds that of one joint.
    {"turning-seen-from-proximal", SINEW_OWN "turning-seen-from-proximal",
     "pose:pose from:velocity-twist -> to:velocity-twist",
     "from.seen = pose.of; to.seen = pose.wrt; to.ref = from.ref; to.of = from.of; "
     "to.wrt = from.wrt",
     "w_A = R w_B, v_A = 0"},
    {"add-linear-motion-of-column", SINEW_OWN "add-linear-motion-of-column",
     "twist:velocity-twist column:jacobian-column velocity:joint-velocity -> with:velocity-twist",
     "column.at = twist.at; with.at = twist.at; with.of = twist.of; with.wrt = twist.wrt",
     "v + J_v qd"},

    // Columns of Jacobians: of a point that moves with F, and of the same point as it would move
    // with G. `between` is the pose of F with respect to G.
    {"jacobian-column-between", SINEW_OWN "jacobian-column-between",
     "between:pose moved:jacobian-column moving:jacobian-column -> column:jacobian-column",
     "moved.of = between.of; moving.wrt = moved.wrt; moving.at = moved.at; "
     "column.of = between.of; column.wrt = between.wrt; column.at = moved.at",
     "J_FG = J_F - J_G"},
    {"jacobian-columns-between", SINEW_OWN "jacobian-columns-between",
     "between:pose moved:jacobian-block moving:jacobian-block -> columns:jacobian-block",
     "moved.of = between.of; moving.wrt = moved.wrt; moving.at = moved.at; "
     "columns.of = between.of; columns.wrt = between.wrt; columns.at = moved.at",
     "J_FG = J_F - J_G"},
    {"rotate-jacobian-column-to-distal", SINEW_OWN "rotate-jacobian-column-to-distal",
     "pose:pose from:jacobian-column -> to:jacobian-column",
     "from.seen = pose.wrt; to.seen = pose.of; to.ref = from.ref; to.of = from.of; "
     "to.wrt = from.wrt",
     "R' J"},
    {"rotate-jacobian-columns-to-distal", SINEW_OWN "rotate-jacobian-columns-to-distal",
     "pose:pose from:jacobian-block -> to:jacobian-block",
     "from.seen = pose.wrt; to.seen = pose.of; to.ref = from.ref; to.of = from.of; "
     "to.wrt = from.wrt",
     "R' J"},

    // Coordinates of a pose, and their derivatives from a geometric Jacobian with the directions of
    // the frame that the pose is with respect to.
    {"position-and-quaternion-from-pose", SINEW_OWN "position-and-quaternion-from-pose",
     "pose:pose -> coordinates:position-and-quaternion",
     "coordinates.of = pose.of; coordinates.wrt = pose.wrt", "x y z, then x y z w with w >= 0"},
    {"quaternion-column-from-jacobian-column", SINEW_OWN "quaternion-column-from-jacobian-column",
     "coordinates:position-and-quaternion column:jacobian-column -> rates:quaternion-column",
     "column.of = coordinates.of; column.wrt = coordinates.wrt; column.seen = coordinates.wrt; "
     "rates.of = coordinates.of; rates.wrt = coordinates.wrt",
     "velocity, then (w, 0) q / 2"},
    {"quaternion-columns-from-jacobian-columns",
     SINEW_OWN "quaternion-columns-from-jacobian-columns",
     "coordinates:position-and-quaternion columns:jacobian-block -> rates:quaternion-block",
     "columns.of = coordinates.of; columns.wrt = coordinates.wrt; columns.seen = coordinates.wrt; "
     "rates.of = coordinates.of; rates.wrt = coordinates.wrt",
     "velocity, then (w, 0) q / 2"},
    {"analytic-jacobian-from-columns", SINEW_OWN "analytic-jacobian-from-columns",
     "columns*:quaternion-column -> jacobian:analytic-jacobian",
     "jacobian.of = columns.of; jacobian.wrt = columns.wrt", "7 x n, row by row"},
    {"floating-analytic-jacobian-from-columns", SINEW_OWN "floating-analytic-jacobian-from-columns",
     "base:quaternion-block columns*:quaternion-column -> jacobian:analytic-jacobian",
     "columns.of = base.of; columns.wrt = base.wrt; jacobian.of = base.of; "
     "jacobian.wrt = base.wrt",
     "7 x (6 + n), row by row"},
};

}  // namespace

std::span<const OperatorRow> relative_operator_rows() { return kRows; }

}  // namespace sinew::algorithm
