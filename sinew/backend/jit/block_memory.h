// What the function of a block has in memory besides inputs and results: sines and cosines, values
// that wait, all as wide as a vector, and constants, each once, which instructions read for all
// lanes. Vectors lie near a pointer that LLVM knows nothing of: an address of one byte counts in
// whole vectors there, and in numbers for what is read for all lanes. What is fetched is fetched
// there and then (loads are volatile): what to hold in registers is said by register_plan.h.
#pragma once

#include <cstddef>
#include <vector>

#include "sinew/backend/jit/place.h"

namespace sinew::backend {

class BlockMemory {
 public:
  // `type`: a vector of numbers.
  BlockMemory(const Place& place, LLVMTypeRef type, std::size_t angles, std::size_t waiting);

  LLVMValueRef sines() const { return array_; }  // those of all angles, behind them the cosines
  void begin();                                  // when they are written

  LLVMValueRef sine(std::size_t angle) const { return load_at(angle); }
  LLVMValueRef cosine(std::size_t angle) const { return load_at(angles_ + angle); }
  LLVMValueRef waiting(std::size_t slot) const { return load_at(2 * angles_ + slot); }
  void keep(LLVMValueRef value, std::size_t slot) const;
  LLVMValueRef constant(double value);

  // After all else: the table of constants.
  void end();

 private:
  LLVMValueRef address(std::size_t at) const;
  LLVMValueRef load_at(std::size_t at) const;

  Place place_;
  LLVMTypeRef type_, number_;
  std::size_t angles_, size_;
  LLVMValueRef array_ = nullptr;
  std::vector<LLVMValueRef> pointers_;
  LLVMValueRef table_ = nullptr;  // stands for that of the constants until they are known
  LLVMValueRef table_pointer_ = nullptr;
  std::vector<double> constants_;
  std::size_t window_ = 0;  // the first constant that is still in reach
};

}  // namespace sinew::backend
