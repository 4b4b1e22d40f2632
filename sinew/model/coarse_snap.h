// A robot made plainer than it was written: constants within a tolerance of 0, 1 or -1 that
// somebody asked for become exactly that, and every change is told.
#pragma once

#include <string>
#include <vector>

#include "sinew/model/tree.h"

namespace sinew::model {

// The largest tolerance that can be asked for: beyond it, rotations would no longer be rotations
// (kOrthonormalError).
constexpr double kCoarsestSnap = 1e-3;

// Placements of joints and frames (direction cosines to 0 and ±1, lengths [m] to 0), and inertias
// (a centre of mass [m] to an axis, entries of the rotational inertia that are a smaller share of
// its largest to 0). Returns a sentence for each element that changed.
std::vector<std::string> snap_coarsely(Tree& tree, double tolerance, const graph::Terms& terms);

}  // namespace sinew::model
