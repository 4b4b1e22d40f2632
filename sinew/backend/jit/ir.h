// Arithmetic on one scalar or vector type of LLVM IR, so that the code generators read like
// formulas.
#pragma once

#include <llvm-c/Core.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace sinew::backend {

// The same, but LLVM does not look into it: what address it is, or where it lies.
LLVMValueRef hidden(LLVMBuilderRef builder, LLVMValueRef pointer);

// The global that stood for a table until its numbers were known is that table from now on.
// Returns the table.
LLVMValueRef become_table(LLVMValueRef begin, std::vector<LLVMValueRef>& numbers, const char* name);

class Ir {
 public:
  // Where constants are in memory: a load of one lane, of a type as wide as a double.
  using LoadConstant = std::function<LLVMValueRef(std::uint64_t bits, LLVMTypeRef type)>;

  // `type`: double, float, or a vector of them; integers and their bits are for doubles only.
  // `fuse`: multiply_add rounds once. `constant`: for doubles; without it, LLVM says where they
  // are.
  Ir(LLVMBuilderRef builder, LLVMTypeRef type, bool fuse, LoadConstant constant = nullptr);

  LLVMContextRef context() const { return context_; }
  LLVMTypeRef type() const { return type_; }
  unsigned lanes() const { return lanes_; }
  bool fuses() const { return fuse_; }

  LLVMValueRef number(double value) const;  // in every lane; rounded where the type is float
  LLVMValueRef in_every_lane(LLVMValueRef lane) const;
  // The same lanes as doubles, and back to the type; nothing where they are doubles.
  LLVMValueRef to_double(LLVMValueRef a) const;
  LLVMValueRef from_double(LLVMValueRef a) const;
  LLVMValueRef add(LLVMValueRef a, LLVMValueRef b) const;
  LLVMValueRef subtract(LLVMValueRef a, LLVMValueRef b) const;
  LLVMValueRef multiply(LLVMValueRef a, LLVMValueRef b) const;
  LLVMValueRef divide(LLVMValueRef a, LLVMValueRef b) const;
  LLVMValueRef negate(LLVMValueRef a) const;
  LLVMValueRef square_root(LLVMValueRef a) const;
  // a * b + c; one rounding or two, as `fuse` says
  LLVMValueRef multiply_add(LLVMValueRef a, LLVMValueRef b, LLVMValueRef c) const;
  LLVMValueRef less(LLVMValueRef a, LLVMValueRef b) const;  // a mask
  LLVMValueRef select(LLVMValueRef mask, LLVMValueRef if_true, LLVMValueRef if_false) const;

  LLVMValueRef to_integer_bits(LLVMValueRef a) const;  // the same bits as 64-bit integers
  LLVMValueRef add_integer(LLVMValueRef bits, std::uint64_t value) const;
  LLVMValueRef bit_is_set(LLVMValueRef bits, unsigned bit) const;     // a mask
  LLVMValueRef shift_left(LLVMValueRef bits, unsigned places) const;  // towards the sign
  // Where the highest of the bits is set.
  LLVMValueRef flip_sign(LLVMValueRef a, LLVMValueRef bits) const;
  LLVMValueRef magnitude(LLVMValueRef a) const;
  LLVMValueRef magnitude_at_most(LLVMValueRef a, double limit) const;  // a mask; false for NaN
  LLVMValueRef all(LLVMValueRef mask) const;                           // one bit

  // An array of n values of the type, as a pointer to its first; allocated in the entry block.
  LLVMValueRef entry_array(LLVMValueRef function, std::size_t n) const;
  void store_element(LLVMValueRef value, LLVMValueRef array, std::size_t index) const;
  LLVMValueRef load_element(LLVMValueRef array, std::size_t index) const;

 private:
  LLVMValueRef integer(std::uint64_t value) const;
  LLVMValueRef load_in_every_lane(std::uint64_t bits, LLVMTypeRef lane) const;
  LLVMValueRef element(LLVMValueRef array, std::size_t index) const;
  LLVMValueRef intrinsic(const char* name, LLVMValueRef* arguments, unsigned count) const;

  LLVMBuilderRef builder_;
  LLVMContextRef context_;
  LLVMTypeRef type_;
  LLVMTypeRef element_type_;
  LLVMTypeRef integer_type_;
  unsigned lanes_;
  bool fuse_;
  LoadConstant constant_;
};

}  // namespace sinew::backend
