// What a computation does, on numbers of one type: floats, doubles or vectors of them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sinew/backend/jit/ir.h"
#include "sinew/backend/jit/place.h"
#include "sinew/program/dag/dag.h"

namespace sinew::backend {

// The value of a node that is not computed here, or no longer in a register; null: compute it.
using Fetch = std::function<LLVMValueRef(std::uint32_t node)>;

class ComputationEmitter {
 public:
  ComputationEmitter(const program::Computation& computation, const Place& place, LLVMTypeRef type,
                     Fetch fetch);

  // All nodes that anything depends on, operands first.
  std::vector<std::uint32_t> order() const;
  // Whether a node is computed on its own: neither an input, a constant or a condition, nor part of
  // the one sum that needs it.
  bool is_statement(std::uint32_t node) const;
  // What such a node reads: statements and what is fetched.
  void for_each_operand(std::uint32_t node,
                        const std::function<void(std::uint32_t operand)>& visit) const;
  // Nodes whose sine or cosine is needed and that are inputs.
  std::vector<std::uint32_t> angles_that_are_inputs() const;

  // Those of an angle, in double: they need not be computed here.
  void set_sine(std::uint32_t angle, LLVMValueRef sine, LLVMValueRef cosine);
  // Sine and cosine of this angle are always fetched: from now on they are no statements.
  void fetch_sine(std::uint32_t angle) { fetched_[angle] = true; }

  LLVMValueRef compute(std::uint32_t node);
  // Fetches or computes it, unless that has been done.
  LLVMValueRef value(std::uint32_t node);
  LLVMValueRef signed_value(program::Ref ref);
  // The value if it is there.
  LLVMValueRef held(std::uint32_t node) const { return values_[node]; }
  void hold(std::uint32_t node, LLVMValueRef value) { values_[node] = value; }
  void forget(std::uint32_t node) { values_[node] = nullptr; }

 private:
  void count_uses();

  // A product that only one sum needs becomes part of that sum's fused multiply-add.
  bool is_product_of_one_use(program::Ref ref) const;
  // At most one operand of a sum is fused into it: the second where it can be.
  bool fuses_second(const program::Node& sum) const { return is_product_of_one_use(sum.b); }
  bool fuses_first(const program::Node& sum) const;

  bool is_fetched(std::uint32_t node) const;
  LLVMValueRef with_sign(LLVMValueRef value, bool negative);
  LLVMValueRef sum(const program::Node& node);
  void emit_single_sine(std::uint32_t angle);

  const program::Computation& computation_;
  const program::Dag& dag_;
  LLVMBuilderRef builder_;
  LLVMValueRef function_;
  LLVMValueRef repair_;
  Fetch fetch_;
  Ir ir_;
  bool fuse_;
  std::vector<std::uint8_t> live_;
  std::vector<std::uint32_t> uses_;
  std::vector<LLVMValueRef> values_;  // by node
  std::vector<LLVMValueRef> sine_;    // by the angle's node
  std::vector<LLVMValueRef> cosine_;
  std::vector<bool> fetched_;  // by the angle's node
  std::vector<bool> fused_;    // by node: part of the one sum that needs it
};

}  // namespace sinew::backend
