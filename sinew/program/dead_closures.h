// Removes what no output and no state depends on.
#pragma once

#include "sinew/program/program.h"

namespace sinew::program {

// The same program with only those closures, in schedule order, and only the variables that they
// use; the inputs and outputs all stay, so that the interface is the same. Precondition: the
// program is valid.
Program without_dead_closures(Program program);

}  // namespace sinew::program
