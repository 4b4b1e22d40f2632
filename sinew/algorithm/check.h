// What must hold of an algorithm before a program is made of it.
//
// Of a closure: every port is connected, to a data block of the port's quantity, and the frames
// obey the operator's rules. Of the whole: every data block that is read has been written before
// (or is an input, a constant or a state), by one closure at most; inputs and constants are written
// by none; every closure in the schedule is there once; every data block has the size, the unit,
// the symbols and the value that its quantity and role ask for. With one writer each and written
// before read there is no cycle; a cycle is found as a read before the write.
#pragma once

#include "sinew/algorithm/model.h"
#include "sinew/base/error.h"

namespace sinew::algorithm {

void check_block(const graph::Terms& terms, const Block& block, Report& report);
void check_closure(const graph::Terms& terms, const Algorithm& algorithm, const Closure& closure,
                   Report& report);
// What does not hold of each block and closure by itself.
void check_together(const graph::Terms& terms, const Algorithm& algorithm, Report& report);
// All of it.
void check_algorithm(const graph::Terms& terms, const Algorithm& algorithm, Report& report);

}  // namespace sinew::algorithm
