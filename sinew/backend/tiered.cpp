#include "sinew/backend/tiered.h"

#include "sinew/base/error.h"
#include "sinew/program/scalar_program.h"

namespace sinew::backend {

Tiered::Tiered(program::Program program, JitOptions options) : interpreter_(program) {
  if (interpreter_.state_size() > 0) {
    throw Error({{},
                 program.iri,
                 "a program with states cannot change its back end while it runs",
                 "interpret it or compile it first",
                 Severity::kError,
                 {}});
  }
  compiler_ = std::thread([this, program = std::move(program), options = std::move(options)] {
    try {
      compiled_ = jit_compile(program::scalar_program(program), options);
      code_.store(&*compiled_, std::memory_order_release);
    } catch (const std::exception& error) {
      fault_ = error.what();
    }
  });
}

Tiered::~Tiered() { wait(); }

void Tiered::wait() {
  if (compiler_.joinable()) compiler_.join();
}

}  // namespace sinew::backend
