#include "sinew/program/passes/fuse_multiply_add.h"

namespace sinew::program {

void fuse_multiply_add(Polynomials& system) {
  system.read();
  system.write(Association::kFused);
}

}  // namespace sinew::program
