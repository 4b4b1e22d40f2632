// Sines and cosines of many angles at once, as LLVM IR on vectors.
//
// Method: Cody & Waite reduction by multiples of pi/2 in three parts of 33, 33 and 53 bits (exact
// products for quotients below 2^20), then the minimax polynomials of fdlibm's __kernel_sin and
// __kernel_cos (Sun Microsystems, 1993) on [-pi/4, pi/4] with the remainder's low part. Error below
// 1 ulp for |x| <= 1e5. Angles beyond, infinities and NaN are repaired by a call to libm, lane by
// lane, so no lane depends on its neighbours.
#pragma once

#include <llvm-c/Core.h>

#include <cstddef>
#include <vector>

#include "sinew/backend/jit/ir.h"
#include "sinew/backend/jit/place.h"

namespace sinew::backend {

inline constexpr unsigned kSineLanes = 8;     // angles in a vector of doubles
inline constexpr double kLargestAngle = 1e5;  // beyond, the fast method does not cover it

// Of one angle or a vector of them, by the fast method.
struct SincosPair {
  LLVMValueRef sine, cosine;
};
SincosPair fast_sincos(const Ir& ir, LLVMValueRef angle);

struct SincosValues {
  std::vector<LLVMValueRef> sine, cosine;  // as wide as the angles; null: in memory only
};
// Of several, operation by operation.
SincosValues fast_sincos_in_step(const Ir& ir, const std::vector<LLVMValueRef>& angles);

// `angles` are doubles or vectors of doubles, all of the same type. Leaves the builder in the block
// where the code goes on. `repair` is a declaration of kSincosRepairName in the same module.
SincosValues emit_sincos(LLVMBuilderRef builder, LLVMValueRef function, LLVMValueRef repair,
                         const std::vector<LLVMValueRef>& angles, bool fuse);

// The same of vectors, all as wide, written to an array: all sines, behind them all cosines. Behind
// those it has as many numbers again for the angles, should they need repair, which happens in
// place. Where there are many of them, all but the last vector are computed by a loop, and are in
// the array only: copies of the code take 270 bytes each. Two pointers that are needed
// afterwards come back from it, so that they need be kept nowhere where it is not called.
SincosValues emit_sincos_to(const Place& place, const std::vector<LLVMValueRef>& angles,
                            LLVMValueRef array, LLVMValueRef& first, LLVMValueRef& second);

// Replaces what is wrong for angles that the fast method does not cover. `values`: n sines, n
// cosines and the n angles. Returns the two pointers as they are.
struct SincosPointers {
  const void* first;
  void* second;
};
extern "C" SincosPointers sinew_sincos_repair(const void* first, void* second, double* values,
                                              std::size_t n);

}  // namespace sinew::backend
