#include "sinew/program/passes/flatten_sums.h"

namespace sinew::program {

void flatten_sums(Polynomials& system) {
  system.read();
  system.write(Association::kPlain);
}

}  // namespace sinew::program
