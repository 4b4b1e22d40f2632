// Sines and cosines of single numbers, which share vectors of doubles.
#pragma once

#include <vector>

#include "sinew/backend/jit/place.h"
#include "sinew/backend/jit/sincos.h"

namespace sinew::backend {

class PackedSines {
 public:
  // `angles` are floats or doubles.
  PackedSines(const Place& place, const std::vector<LLVMValueRef>& angles);

  // Of `width` angles from this one on, a vector where they are several; no pack ends between them.
  LLVMValueRef sine(std::size_t first, unsigned width) const;
  LLVMValueRef cosine(std::size_t first, unsigned width) const;

 private:
  LLVMValueRef integer(std::size_t value) const;

  LLVMValueRef part(const std::vector<LLVMValueRef>& packs, std::size_t first,
                    unsigned width) const;

  LLVMBuilderRef builder_ = nullptr;
  LLVMContextRef context_ = nullptr;
  unsigned width_ = kSineLanes;
  SincosValues values_;
};

}  // namespace sinew::backend
