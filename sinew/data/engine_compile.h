// Machine code for a converter's operations: the same loads, arithmetic and stores in the same
// order, with the numbers in the processor's registers. What is not arithmetic on doubles (whole
// numbers, paths behind pointers, guards, sine and cosine, functions of libraries) is left to the
// interpreter, one operation at a time. Internal to the module.
#pragma once

#include "sinew/data/engine.h"

namespace sinew::data {

// Does nothing, and the interpreter stays, on other processors than x86-64 and where the system
// gives no memory that can be run.
void compile(Converter& converter);

}  // namespace sinew::data
