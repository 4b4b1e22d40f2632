// Divides once by what several quotients are divided by: x / d and y / d become x r and y r with r
// = 1 / d. A division takes as long as three or four multiplications.
#pragma once

#include "sinew/program/dag/dag.h"

namespace sinew::program {

Computation share_denominators(Computation computation);

}  // namespace sinew::program
