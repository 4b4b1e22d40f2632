// What a computation does, on numbers of one type: floats, doubles or vectors of them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sinew/backend/jit/ir.h"
#include "sinew/backend/jit/place.h"
#include "sinew/program/dag/dag.h"

namespace sinew::backend {

using Load = std::function<LLVMValueRef(std::uint32_t input)>;
// Called with the value of each node in turn.
using Computed = std::function<void(std::uint32_t node, LLVMValueRef value)>;

class ComputationEmitter {
 public:
  ComputationEmitter(const program::Computation& computation, const Place& place, LLVMTypeRef type,
                     Load load);

  // Nodes whose sine or cosine is needed and that are inputs.
  std::vector<std::uint32_t> angles_that_are_inputs() const;

  // Those of an angle, in double: they need not be computed here.
  void set_sine(std::uint32_t angle, LLVMValueRef sine, LLVMValueRef cosine);

  // The results. `computed` may write them as soon as they are there, so that they need no register
  // to the end.
  std::vector<LLVMValueRef> emit(const Computed& computed);

 private:
  void count_uses();

  // All angles that are inputs: one vectorised evaluation at the start. Angles that are computed
  // get theirs where they are needed.
  void emit_sines_of_inputs();

  LLVMValueRef signed_value(program::Ref ref);

  // Operands come first in the order, so this recursion is shallow.
  LLVMValueRef value(std::uint32_t index);

  // A product that only one sum needs becomes part of that sum's fused multiply-add.
  bool is_product_of_one_use(program::Ref ref) const;
  // At most one operand of a sum is fused into it: the second where it can be.
  bool fuses_second(const program::Node& sum) const { return is_product_of_one_use(sum.b); }
  bool fuses_first(const program::Node& sum) const;
  bool is_fused(std::uint32_t index) const { return fused_[index]; }

  LLVMValueRef compute(std::uint32_t index);

  LLVMValueRef with_sign(LLVMValueRef value, bool negative);

  LLVMValueRef sum(const program::Node& node);

  void emit_single_sine(std::uint32_t angle);

  const program::Computation& computation_;
  const program::Dag& dag_;
  LLVMBuilderRef builder_;
  LLVMValueRef function_;
  LLVMValueRef repair_;
  Load load_;
  Ir ir_;
  bool fuse_;
  std::vector<std::uint8_t> live_;
  std::vector<std::uint32_t> uses_;
  std::vector<LLVMValueRef> values_;  // by node
  std::vector<LLVMValueRef> sine_;    // by the angle's node
  std::vector<LLVMValueRef> cosine_;
  std::vector<bool> fused_;  // by node: part of the one sum that needs it
};

}  // namespace sinew::backend
