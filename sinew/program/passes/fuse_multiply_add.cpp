#include "sinew/program/passes/fuse_multiply_add.h"

#include "sinew/program/passes/polynomials.h"

namespace sinew::program {

Computation fuse_multiply_add(Computation computation) {
  return write_polynomials(read_polynomials(std::move(computation)), Association::kFused);
}

}  // namespace sinew::program
