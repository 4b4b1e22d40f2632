// The few x86-64 instructions that arithmetic on doubles needs, and memory to run them in. Internal
// to the module; engine_compile.cpp decides what to write.
//
// Encodings: Intel 64 and IA-32 Architectures Software Developer's Manual, volume 2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace sinew::data {

// General registers by their number in instructions.
enum class General : std::uint8_t {
  kAx = 0,
  kCx = 1,
  kDx = 2,
  kBx = 3,
  kSp = 4,
  kSi = 6,
  kDi = 7,
  k8 = 8,
  k9 = 9,
  k12 = 12,
  k13 = 13,
  k14 = 14,
  k15 = 15,
};
using Vector = std::uint8_t;  // xmm0 to xmm15
inline constexpr Vector kVectors = 16;

// Operations on the low double of two vector registers, or of one and memory.
enum class Instruction : std::uint8_t {
  kMove,  // of one double
  kMoveStore,
  kMoveFloatStore,
  kMoveAll,  // between vector registers
  kAdd,
  kMultiply,
  kSubtract,
  kDivide,
  kSquareRoot,
  kAnd,  // bit by bit, both operands as a whole
  kAndNot,
  kOr,
  kExclusiveOr,
  kFloatToDouble,
  kDoubleToFloat,
};

class MachineCode {
 public:
  void instruction(Instruction which, Vector target, Vector source);
  // Memory at base + offset; for the stores `target` is what is stored.
  void instruction(Instruction which, Vector target, General base, std::int32_t offset);
  // One of the constants that lie behind the code; a second half of zeros makes it a whole vector.
  void with_constant(Instruction which, Vector target, double constant);
  void with_bits(Instruction which, Vector target, std::uint64_t both_halves);

  enum class Compare : std::uint8_t { kLess = 1, kNotEqual = 4 };  // kNotEqual: true for NaN
  void compare(Compare how, Vector target, Vector source);

  void landing();  // marks a place that calls through a pointer may reach
  void push(General reg);
  void pop(General reg);
  void move(General target, General source);
  void load(General target, General base, std::int32_t offset);
  void load_number(General target, std::uint64_t number);
  void call(const void* function, General through);
  // Leaves through the code's end, with what is in ax, when its lowest byte is 0.
  void leave_if_false();
  void mark_end();  // where leave_if_false goes
  void return_();

  // Copies the code to memory that can be run and no longer be written. Nothing where the system
  // refuses.
  std::shared_ptr<const void> finish();

 private:
  void byte(unsigned value) { bytes_.push_back(static_cast<std::uint8_t>(value)); }
  void number(std::uint64_t value, int bytes);
  void opcode(Instruction which, unsigned reg, unsigned other);
  void memory(unsigned reg, General base, std::int32_t offset);
  void pooled(Instruction which, Vector target, std::uint64_t low, std::uint64_t high);

  struct Half {
    std::uint64_t low, high;
  };
  std::vector<std::uint8_t> bytes_;
  std::vector<Half> pool_;
  std::vector<std::pair<std::size_t, std::size_t>> uses_;  // place of the offset, number in pool
  std::vector<std::size_t> leaves_;
  std::size_t end_ = 0;
};

}  // namespace sinew::data
