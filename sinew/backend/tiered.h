// A program that runs at once and gets fast by itself: interpreted until machine code for it is
// ready, which another thread makes meanwhile.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <thread>

#include "sinew/backend/interpreter.h"
#include "sinew/backend/jit.h"
#include "sinew/program/program.h"

namespace sinew::backend {

class Tiered {
 public:
  // Returns as soon as the interpreter is ready; starts the compilation. Where nothing can be
  // compiled the interpreter goes on, and `fault()` says why. Throws Error for a program that is
  // not valid, or that has states (they live in the back end that runs it).
  explicit Tiered(program::Program program, JitOptions options = {});
  ~Tiered();  // waits for a compilation that is under way
  Tiered(const Tiered&) = delete;
  Tiered& operator=(const Tiered&) = delete;

  // One evaluation, by one thread at a time. Real-time safe: bounded, without allocation or locks;
  // goes over to machine code from one call to the next.
  void evaluate(const double* in, double* out) {
    if (const JitFunction* code = code_.load(std::memory_order_acquire)) {
      (*code)(in, out);
    } else {
      interpreter_.evaluate(in, out);
    }
  }

  bool is_compiled() const { return code_.load(std::memory_order_acquire) != nullptr; }
  void wait();  // until the compilation has ended, well or not
  // Why there is no machine code; empty while it is being made and when it is there. Call after
  // wait().
  const std::string& fault() const { return fault_; }

 private:
  Interpreter interpreter_;
  std::optional<JitFunction> compiled_;
  std::string fault_;
  std::atomic<const JitFunction*> code_ = nullptr;
  std::thread compiler_;
};

}  // namespace sinew::backend
