#include "sinew/program/passes/reassociate.h"

namespace sinew::program {

void reassociate(Polynomials& system) {
  system.read();
  system.write(Association::kShallow);
}

}  // namespace sinew::program
