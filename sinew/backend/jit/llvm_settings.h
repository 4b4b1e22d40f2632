// How LLVM's code generator is set up for straight-line code of thousands of operations.
#pragma once

namespace sinew::backend {

// Once in a process, before anything is compiled. Only where LLVM is part of this library are its
// options ours to set; with a shared LLVM it does nothing.
void set_up_code_generator();

// Who says in which order this thread's code is computed and what gets a register, as long as it
// lives.
class CodeOrder {
 public:
  enum Who {
    kPlanned,               // the order stays, and as many values at a time as there are registers
                            // (register_allocator.h)
    kAsWritten,             // the order stays; LLVM's basic allocator
    kRegistersByGenerator,  // the order stays; LLVM's greedy allocator
    kByGenerator            // LLVM's scheduler and greedy allocator: most of a compilation's time
  };
  explicit CodeOrder(Who who);
  ~CodeOrder();
  CodeOrder(const CodeOrder&) = delete;
  CodeOrder& operator=(const CodeOrder&) = delete;
};

}  // namespace sinew::backend
