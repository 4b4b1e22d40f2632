// Multiplies sums out where that makes terms meet: 2 (a + b) + 3 (a - b) becomes 5 a - b, which
// saves the additions inside the brackets if nobody else uses them.
#pragma once

#include "sinew/program/dag/dag.h"

namespace sinew::program {

Computation merge_terms(Computation computation);

}  // namespace sinew::program
