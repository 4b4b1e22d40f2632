// Operators of joints with several degrees of freedom, of joints that follow others, of rotors
// behind gears, and of the mass matrix' factors. Their functions are in math/compound_joint.h.
#include "sinew/algorithm/operator_rows.h"

namespace sinew::algorithm {
namespace {

#define SINEW_TO_MAP "number.of = map.of; number.wrt = map.wrt; number.seen = map.seen"

constexpr OperatorRow kRows[] = {
    // Spherical joints, and floating ones that are not a base. The pose is that across the first of
    // the turns that the tree has for the joint (docs/joints.md), the twists those across the last.
    {"position-to-pose-spherical", SINEW_OWN "position-to-pose-spherical",
     "position:spherical-position -> pose:pose", "pose.of = position.of; pose.wrt = position.wrt",
     "X = [P' R(quaternion) P, 0], P the turn from an axis to the next"},
    {"position-to-pose-free", SINEW_OWN "position-to-pose-free",
     "position:floating-position -> pose:pose", "pose.of = position.of; pose.wrt = position.wrt",
     "X = [P' R(quaternion) P, P' p], P the turn from an axis to the next"},
    {"velocity-to-twist-spherical", SINEW_OWN "velocity-to-twist-spherical",
     "velocity:spherical-velocity -> twist:velocity-twist",
     "twist.of = velocity.of; twist.wrt = velocity.wrt; twist.at = velocity.seen", "V = (qd, 0)"},
    {"acceleration-to-twist-spherical", SINEW_OWN "acceleration-to-twist-spherical",
     "acceleration:spherical-acceleration -> twist:acceleration-twist",
     "twist.of = acceleration.of; twist.wrt = acceleration.wrt; twist.at = acceleration.seen",
     "A = (qdd, 0)"},
    {"spherical-acceleration-of-parts", SINEW_OWN "spherical-acceleration-of-parts",
     "parts*:joint-acceleration map:coordinate-map -> number:spherical-acceleration", SINEW_TO_MAP,
     "one after the other"},
    {"floating-acceleration-of-parts", SINEW_OWN "floating-acceleration-of-parts",
     "parts*:joint-acceleration map:coordinate-map -> number:floating-acceleration", SINEW_TO_MAP,
     "one after the other"},

    // One number from those of a joint with several, or of all joints; one that follows another. A
    // map has the count of numbers, a factor for each, and what is added.
    {"position-of-part", SINEW_OWN "position-of-part",
     "numbers*:joint-positions map:coordinate-map -> number:joint-position", SINEW_TO_MAP,
     "r . q + o"},
    {"velocity-of-part", SINEW_OWN "velocity-of-part",
     "numbers*:joint-velocities map:coordinate-map -> number:joint-velocity", SINEW_TO_MAP,
     "r . qd"},
    {"acceleration-of-part", SINEW_OWN "acceleration-of-part",
     "numbers*:joint-accelerations map:coordinate-map -> number:joint-acceleration", SINEW_TO_MAP,
     "r . qdd"},
    {"force-of-part", SINEW_OWN "force-of-part",
     "numbers*:joint-forces map:coordinate-map -> number:joint-force", SINEW_TO_MAP, "r . tau"},
    {"position-from-leader", SINEW_OWN "position-from-leader",
     "leader*:joint-position map:coordinate-map -> number:joint-position", SINEW_TO_MAP, "r q + o"},
    {"velocity-from-leader", SINEW_OWN "velocity-from-leader",
     "leader*:joint-velocity map:coordinate-map -> number:joint-velocity", SINEW_TO_MAP, "r qd"},
    {"acceleration-from-leader", SINEW_OWN "acceleration-from-leader",
     "leader*:joint-acceleration map:coordinate-map -> number:joint-acceleration", SINEW_TO_MAP,
     "r qdd"},
    {"floating-acceleration-of-robot", SINEW_OWN "floating-acceleration-of-robot",
     "numbers*:joint-accelerations map:coordinate-map -> number:floating-acceleration",
     SINEW_TO_MAP, "the first six"},

    // The force that drives a joint and all that follow it; the numbers of several joints together.
    {"force-of-coupled", SINEW_OWN "force-of-coupled",
     "forces*:joint-force map:coordinate-map -> number:joint-force", SINEW_TO_MAP, "r . tau"},
    {"join-joint-forces", SINEW_OWN "join-joint-forces",
     "forces*:joint-force -> joined:joint-forces", "", "one after the other"},
    {"join-joint-accelerations", SINEW_OWN "join-joint-accelerations",
     "accelerations*:joint-acceleration -> joined:joint-accelerations", "", "one after the other"},
    {"join-floating-forces", SINEW_OWN "join-floating-forces",
     "base:floating-force forces*:joint-force -> joined:joint-forces", "", "one after the other"},

    // A rotor behind a gear resists acceleration of its joint, as far as it turns about its own
    // axis.
    {"force-with-rotor", SINEW_OWN "force-with-rotor",
     "force:joint-force acceleration:joint-acceleration rotor:rotor-inertia -> with:joint-force",
     "with.of = force.of; with.wrt = force.wrt; with.seen = force.seen; acceleration.of = force.of",
     "tau + I qdd"},
    {"unit-force-with-rotor", SINEW_OWN "unit-force-with-rotor",
     "force:joint-force rotor:rotor-inertia -> with:joint-force",
     "with.of = force.of; with.wrt = force.wrt; with.seen = force.seen", "D + I"},

    // From matrices of all joints of the tree to those of the coordinates: velocities are G times
    // the coordinates'. The map has n, m, G (n x m), and for the mass matrix the rotors' inertias.
    {"couple-mass-matrix", SINEW_OWN "couple-mass-matrix",
     "matrix*:mass-matrix map:coordinate-map -> coupled:mass-matrix", "", "G' (M + I) G"},
    {"couple-jacobian", SINEW_OWN "couple-jacobian",
     "matrix*:jacobian map:coordinate-map -> coupled:jacobian",
     "coupled.of = matrix.of; coupled.wrt = matrix.wrt; coupled.at = matrix.at", "J G"},
    {"couple-analytic-jacobian", SINEW_OWN "couple-analytic-jacobian",
     "matrix*:analytic-jacobian map:coordinate-map -> coupled:analytic-jacobian",
     "coupled.of = matrix.of; coupled.wrt = matrix.wrt", "J G"},
    {"couple-linear-jacobian", SINEW_OWN "couple-linear-jacobian",
     "matrix*:linear-jacobian map:coordinate-map -> coupled:linear-jacobian",
     "coupled.of = matrix.of; coupled.wrt = matrix.wrt; coupled.seen = matrix.seen", "J G"},
    {"couple-momentum-matrix", SINEW_OWN "couple-momentum-matrix",
     "matrix*:momentum-matrix map:coordinate-map -> coupled:momentum-matrix",
     "coupled.of = matrix.of; coupled.at = matrix.at", "A G"},

    // The map holds the number of rows.
    {"factorise-mass-matrix", SINEW_OWN "factorise-mass-matrix",
     "matrix*:mass-matrix map:coordinate-map -> factor:cholesky-factor", "",
     "L of M = L' L, lower triangular, row by row"},
    {"decompose-mass-matrix", SINEW_OWN "decompose-mass-matrix",
     "matrix*:mass-matrix map:coordinate-map -> decomposition:mass-matrix-decomposition", "",
     "L and D of M = L' D L: L below the diagonal, D on it"},
    {"acceleration-from-decomposition", SINEW_OWN "acceleration-from-decomposition",
     "decomposition*:mass-matrix-decomposition force:joint-forces bias:joint-forces "
     "map:coordinate-map -> acceleration:joint-accelerations",
     "", "qdd = M^-1 (tau - h)"},
    {"drive-from-decomposition", SINEW_OWN "drive-from-decomposition",
     "decomposition*:mass-matrix-decomposition force:joint-forces map:coordinate-map -> "
     "drive:joint-forces",
     "", "L' e = tau"},
    {"acceleration-from-drive", SINEW_OWN "acceleration-from-drive",
     "decomposition*:mass-matrix-decomposition drive:joint-forces map:coordinate-map -> "
     "acceleration:joint-accelerations",
     "", "D L qdd = e"},
    {"acceleration-energy-of-drives", SINEW_OWN "acceleration-energy-of-drives",
     "decomposition*:mass-matrix-decomposition drive1:joint-forces drive2:joint-forces "
     "map:coordinate-map -> energy:acceleration-energy",
     "", "e_1' D^-1 e_2 = tau_1' M^-1 tau_2"},
    {"weigh-drives", SINEW_OWN "weigh-drives",
     "drives*:joint-forces magnitudes*:magnitude map:coordinate-map -> sum:joint-forces", "",
     "sum of x_k e_k"},
};

}  // namespace

std::span<const OperatorRow> joint_operator_rows() { return kRows; }

}  // namespace sinew::algorithm
