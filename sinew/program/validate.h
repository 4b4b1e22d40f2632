// Whether a program can be evaluated at all. Every back end may rely on it, so that none needs a
// check of its own.
#pragma once

#include "sinew/base/error.h"
#include "sinew/program/program.h"

namespace sinew::program {

// Reports, naming variables and closures by their IRIs:
// - a variable without name or size, two of the same name, values that are missing or not finite;
// - a closure of an unknown operator, with too few or too many arguments, or of other sizes;
// - an index that points nowhere, a closure that is scheduled twice;
// - a variable that is read before it is written, or written twice, or written although it is an
// input or
//   a constant; an output that nothing writes.
void validate(const Program& program, Report& report);

// Throws Error with everything that `validate` reports.
void require_valid(const Program& program);

}  // namespace sinew::program
