// Which register each value of straight-line code gets.
//
// How many values are in registers at a time is planned before (register_plan.h), and then whoever
// hands out registers in the order in which values begin never runs out: values of straight-line
// code are intervals. LLVM's basic allocator takes the most used value first and finds no place
// for some of the others; they go to the stack in spite of the plan.
//
// Some registers have shorter names. An instruction of AVX-512 that names one of the upper sixteen
// has one or two bytes more, so these are for values that are named seldom for as long as they
// live.
#pragma once

#ifdef SINEW_OWN_LLVM

namespace llvm {
class FunctionPass;
}

namespace sinew::backend {

// LLVM owns it.
llvm::FunctionPass* create_ordered_allocator();

}  // namespace sinew::backend

#endif
