// Addresses in a structure of arrays: rows whose distance the caller says when it calls.
//
// An instruction adds one, two, four or eight times a register to a pointer for nothing. With one
// distance, three and five of them in registers most rows that are needed next are in reach of a
// pointer that is there; where none is, one more instruction makes another.
#pragma once

#include <llvm-c/Core.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sinew::backend {

class RowDistances {
 public:
  // `bytes`: from one row to the next.
  RowDistances(LLVMBuilderRef builder, LLVMValueRef bytes);

  // So many rows on, as part of an instruction.
  bool reaches(std::size_t rows) const;
  LLVMValueRef move(LLVMValueRef pointer, std::size_t rows) const;
  // A new pointer, any number of rows on, in as few instructions as it takes.
  LLVMValueRef move_far(LLVMValueRef pointer, std::size_t rows) const;

 private:
  LLVMBuilderRef builder_;
  LLVMValueRef distances_[3];
};

// The rows of one array.
class RowAddresses {
 public:
  // `rows`: as they will be asked for; it says which pointers are worth making. `pointers`: that
  // are there at a time; each takes a register.
  RowAddresses(LLVMBuilderRef builder, const RowDistances& distances, LLVMValueRef array,
               std::vector<std::uint32_t> rows, std::size_t pointers);

  LLVMValueRef of(std::uint32_t row);

 private:
  struct Pointer {
    LLVMValueRef value = nullptr;
    std::size_t row = 0, used = 0;
  };
  bool is_reached(std::size_t row, std::size_t from) const;
  std::size_t reached_from(std::size_t row) const;
  Pointer make_pointer(std::size_t row) const;
  Pointer& pointer_for(std::size_t row);

  const RowDistances& distances_;
  LLVMBuilderRef builder_;
  LLVMValueRef array_;
  std::vector<std::uint32_t> rows_;
  std::size_t most_;
  std::size_t at_ = 0, time_ = 0;
  std::vector<Pointer> pointers_;
};

}  // namespace sinew::backend
