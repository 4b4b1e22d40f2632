#include "sinew/program/passes/reassociate.h"

#include "sinew/program/passes/polynomials.h"

namespace sinew::program {

Computation reassociate(Computation computation) {
  return write_polynomials(read_polynomials(std::move(computation)), Association::kShallow);
}

}  // namespace sinew::program
