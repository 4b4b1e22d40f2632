// What a function of one sample has in memory: inputs, results, sines and cosines, constants, and
// values that wait. Each lies near a pointer that LLVM knows nothing of, so that instructions
// address it by a register and one byte, not by four bytes from the stack pointer or from
// themselves. What is fetched is fetched there and then (loads are volatile): what to hold in
// registers is said by register_plan.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sinew/backend/jit/address_plan.h"
#include "sinew/backend/jit/place.h"
#include "sinew/backend/jit/sincos.h"

namespace sinew::backend {

// Numbers of each kind.
struct MemorySizes {
  std::size_t inputs = 0, waiting = 0;
  std::vector<std::uint32_t> results;  // those that write_result is called for, in any order
};

class Memory {
 public:
  Memory(const Place& place, LLVMTypeRef number, const MemorySizes& sizes);

  // First of all, if there are angles: computes the sines and cosines of these vectors, all as
  // wide.
  void write_sines(const std::vector<LLVMValueRef>& packs);
  // Then the rest can be used.
  void begin();

  // Loads. `type`: a number or a vector of them; an angle is counted through all packs.
  LLVMValueRef input(std::size_t index) const;
  LLVMValueRef sine(std::size_t angle, LLVMTypeRef type) const;
  LLVMValueRef cosine(std::size_t angle, LLVMTypeRef type) const;
  LLVMValueRef waiting(std::size_t slot, LLVMTypeRef type) const;
  LLVMValueRef constant(const std::vector<double>& lanes);

  // From the register that it was computed in, if it is in one: sooner there than in memory.
  LLVMValueRef early_sine(std::size_t angle, LLVMTypeRef type) const;
  LLVMValueRef early_cosine(std::size_t angle, LLVMTypeRef type) const;

  void keep(LLVMValueRef value, std::size_t slot) const;
  // A number, or neighbours as a vector: the place of the first.
  void write_result(LLVMValueRef value, std::size_t index) const;
  LLVMValueRef results() const { return out_; }  // where they begin; there before `begin`

  // After all else: the table of constants.
  void end();

 private:
  // Numbers around `at`, counted from the beginning of an array.
  struct Pointer {
    LLVMValueRef value = nullptr;
    std::size_t at = 0;
  };
  LLVMValueRef offset(std::size_t to, std::size_t from) const;
  LLVMValueRef address(LLVMTypeRef number, const Pointer& pointer, std::size_t index) const;
  LLVMValueRef load(LLVMTypeRef type, LLVMValueRef from) const;
  Pointer hidden(LLVMTypeRef number, const Pointer& from, std::size_t at) const;
  Pointer hidden_middle(LLVMTypeRef number, LLVMValueRef array, std::size_t size) const;
  LLVMValueRef array(LLVMTypeRef number, std::size_t size) const;
  const Pointer& near_slot(std::size_t slot) const;
  std::size_t waiting_pointers() const;
  void reach_results();
  LLVMValueRef result_address(std::size_t index) const;
  LLVMValueRef lanes_of(const std::vector<LLVMValueRef>& packs, std::size_t angle,
                        LLVMTypeRef type) const;
  bool is_in_register(std::size_t angle) const;
  LLVMValueRef saved_sine(std::size_t place, LLVMTypeRef type) const;
  LLVMTypeRef of_doubles(LLVMTypeRef type) const;
  std::size_t near(LLVMTypeRef number) const;  // numbers to one side of a pointer

  Place place_;
  LLVMTypeRef number_, double_;
  LLVMContextRef context_;
  MemorySizes sizes_;
  LLVMValueRef in_, out_;
  LLVMValueRef sines_ = nullptr;
  std::size_t cosines_ = 0;  // where they begin behind the sines
  SincosValues early_;
  unsigned sine_lanes_ = 1;  // of those vectors
  Pointer inputs_at_, sines_at_, constants_at_;
  AddressPlan results_plan_;
  std::vector<Pointer> results_at_;          // the plan's bases
  std::vector<LLVMValueRef> results_index_;  // and its indices, in bytes
  std::vector<Pointer> waiting_at_;
  LLVMValueRef table_ = nullptr;  // stands for that of the constants until they are known
  std::vector<double> constants_;
  std::size_t window_ = 0;  // the first constant that is still in reach
};

}  // namespace sinew::backend
