#include "sinew/backend/jit/packed_sines.h"

#include "sinew/backend/jit/ir.h"

namespace sinew::backend {

PackedSines::PackedSines(const Place& place, const std::vector<LLVMValueRef>& angles)
    : builder_(place.builder) {
  if (angles.empty()) return;
  context_ = LLVMGetTypeContext(LLVMTypeOf(angles.front()));
  const Ir number(builder_, LLVMTypeOf(angles.front()), place.fuse);
  width_ = angles.size() > 4 ? kSineLanes : angles.size() > 2 ? 4 : 2;
  std::vector<LLVMValueRef> packs;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (i % width_ == 0)
      packs.push_back(LLVMConstNull(LLVMVectorType(LLVMDoubleTypeInContext(context_), width_)));
    packs.back() = LLVMBuildInsertElement(builder_, packs.back(), number.to_double(angles[i]),
                                          integer(i % width_), "");
  }
  values_ = emit_sincos(builder_, place.function, place.repair, packs, place.fuse);
}

LLVMValueRef PackedSines::sine(std::size_t first, unsigned width) const {
  return part(values_.sine, first, width);
}

LLVMValueRef PackedSines::cosine(std::size_t first, unsigned width) const {
  return part(values_.cosine, first, width);
}

LLVMValueRef PackedSines::integer(std::size_t value) const {
  return LLVMConstInt(LLVMInt64TypeInContext(context_), value, false);
}

LLVMValueRef PackedSines::part(const std::vector<LLVMValueRef>& packs, std::size_t first,
                               unsigned width) const {
  const LLVMValueRef pack = packs[first / width_];
  if (width == 1) return LLVMBuildExtractElement(builder_, pack, integer(first % width_), "");
  const LLVMTypeRef index = LLVMInt32TypeInContext(context_);
  std::vector<LLVMValueRef> lanes;
  for (unsigned lane = 0; lane < width; ++lane)
    lanes.push_back(LLVMConstInt(index, first % width_ + lane, false));
  return LLVMBuildShuffleVector(builder_, pack, LLVMGetUndef(LLVMTypeOf(pack)),
                                LLVMConstVector(lanes.data(), width), "");
}

}  // namespace sinew::backend
