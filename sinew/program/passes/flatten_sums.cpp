#include "sinew/program/passes/flatten_sums.h"

#include "sinew/program/passes/polynomials.h"

namespace sinew::program {

Computation flatten_sums(Computation computation) {
  return write_polynomials(read_polynomials(std::move(computation)), Association::kPlain);
}

}  // namespace sinew::program
