// Operators of hybrid dynamics: acceleration constraints and the drivers that act beside them.
// Their functions are in math/hybrid_dynamics.h and math/constraint_solve.h.
#include "sinew/algorithm/operator_rows.h"

namespace sinew::algorithm {
namespace {

constexpr OperatorRow kRows[] = {
    // A driver's wrench on a body goes inward through joints that give way; each
    // joint's force times the acceleration that another driver causes there adds up to
    // acceleration energies, from which follow the magnitudes of the constraint forces.
    {"subtract-wrench", SINEW_OWN "subtract-wrench", "in1:wrench in2:wrench -> difference:wrench",
     "in1.at = in2.at; difference.at = in1.at; difference.of = in1.of", "W = W_1 - W_2"},
    {"add-joint-force", SINEW_OWN "add-joint-force",
     "in1:joint-force in2:joint-force -> sum:joint-force",
     "in2.of = in1.of; in2.wrt = in1.wrt; in2.seen = in1.seen; sum.of = in1.of; "
     "sum.wrt = in1.wrt; sum.seen = in1.seen",
     "tau = tau_1 + tau_2"},
    {"add-floating-force", SINEW_OWN "add-floating-force",
     "in1:floating-force in2:floating-force -> sum:floating-force",
     "in2.of = in1.of; in2.wrt = in1.wrt; in2.seen = in1.seen; sum.of = in1.of; "
     "sum.wrt = in1.wrt; sum.seen = in1.seen",
     "f = f_1 + f_2"},
    {"joint-acceleration-from-drive", SINEW_OWN "joint-acceleration-from-drive",
     "force:joint-force unit-force:joint-force -> acceleration:joint-acceleration",
     "unit-force.of = force.of; unit-force.seen = force.seen; acceleration.of = force.of; "
     "acceleration.wrt = force.wrt; acceleration.seen = force.seen",
     "qdd = e / D, the predecessor held"},
    {"release-wrench", SINEW_OWN "release-wrench",
     "wrench:wrench unit-wrench:wrench acceleration:joint-acceleration -> released:wrench",
     "unit-wrench.at = wrench.at; released.at = wrench.at; released.of = wrench.of; "
     "unit-wrench.of = acceleration.of; acceleration.seen = wrench.seen",
     "F - U qdd"},
    {"acceleration-energy-of-wrench", SINEW_OWN "acceleration-energy-of-wrench",
     "wrench:wrench acceleration-twist:acceleration-twist -> energy:acceleration-energy",
     "acceleration-twist.at = wrench.at; acceleration-twist.of = wrench.of", "F . A"},
    {"acceleration-energy-of-joint-forces", SINEW_OWN "acceleration-energy-of-joint-forces",
     "forces*:joint-force accelerations*:joint-acceleration -> energy:acceleration-energy", "",
     "sum of e_j qdd_j"},
    {"acceleration-energy-of-floating-force", SINEW_OWN "acceleration-energy-of-floating-force",
     "force:floating-force acceleration:floating-acceleration -> energy:acceleration-energy",
     "acceleration.of = force.of; acceleration.wrt = force.wrt; acceleration.seen = force.seen",
     "e . qdd"},
    {"add-acceleration-energy", SINEW_OWN "add-acceleration-energy",
     "in1:acceleration-energy in2:acceleration-energy -> sum:acceleration-energy", "", "E_1 + E_2"},
    {"subtract-acceleration-energy", SINEW_OWN "subtract-acceleration-energy",
     "in1:acceleration-energy in2:acceleration-energy -> difference:acceleration-energy", "",
     "E_1 - E_2"},
    // The lower triangle of L row by row, r, and the policy's number.
    {"constraint-magnitudes-in-order", SINEW_OWN "constraint-magnitudes-in-order",
     "entries*:acceleration-energy residuals*:acceleration-energy tolerance:magnitude -> "
     "magnitudes:constraint-magnitudes",
     "", "L x = r, x_i = 0 where the ones before leave less than the tolerance of L_ii"},
    {"constraint-magnitudes-damped", SINEW_OWN "constraint-magnitudes-damped",
     "entries*:acceleration-energy residuals*:acceleration-energy tolerance:magnitude -> "
     "magnitudes:constraint-magnitudes",
     "", "least |L x - r|^2 + d^2 |x|^2, each L_ii scaled to 1"},
    {"constraint-magnitudes-truncated", SINEW_OWN "constraint-magnitudes-truncated",
     "entries*:acceleration-energy residuals*:acceleration-energy tolerance:magnitude -> "
     "magnitudes:constraint-magnitudes",
     "", "x = L^+ r without eigenvalues up to the tolerance, each L_ii scaled to 1"},
    {"constraint-magnitude", SINEW_OWN "constraint-magnitude",
     "magnitudes:constraint-magnitudes selection*:magnitude -> magnitude:magnitude", "",
     "sum of s_i x_i"},
    {"weigh-magnitudes", SINEW_OWN "weigh-magnitudes",
     "parts*:magnitude weights*:magnitude -> sum:magnitude", "", "sum of w_k x_k"},
    {"weigh-joint-forces", SINEW_OWN "weigh-joint-forces",
     "forces*:joint-force magnitudes*:magnitude -> sum:joint-force",
     "sum.of = forces.of; sum.wrt = forces.wrt; sum.seen = forces.seen", "sum of x_k e_k"},
    {"weigh-floating-forces", SINEW_OWN "weigh-floating-forces",
     "forces*:floating-force magnitudes*:magnitude -> sum:floating-force",
     "sum.of = forces.of; sum.wrt = forces.wrt; sum.seen = forces.seen", "sum of x_k e_k"},
    {"scale-within-limits", SINEW_OWN "scale-within-limits",
     "rest*:joint-force scaled*:joint-force limits*:joint-force -> scale:magnitude", "",
     "largest s in [0 1] coming from 1 with |rest_j + s scaled_j| <= limit_j for all j, or 0"},
};

}  // namespace

std::span<const OperatorRow> hybrid_operator_rows() { return kRows; }

}  // namespace sinew::algorithm
