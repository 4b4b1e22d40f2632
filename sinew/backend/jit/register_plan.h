// Which values of a long straight-line function are in registers, step by step.
//
// Dynamics of an arm have three times as many values alive as a processor has registers. LLVM's
// allocators, which look at one value after the other, spend a third of the code on writing values
// to the stack and fetching them; for straight-line code one knows when each value is read next,
// and the best choice is to let that one go which is read again last (Belady 1966).
// What goes is written to an array when it is computed, and fetched for its next reader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sinew::backend {

// What is computed and read, step after step. A value that no step computes lies in memory.
class RegisterSteps {
 public:
  explicit RegisterSteps(std::uint32_t values) : widths_(values, 1) {}

  // The present step computes this value, or reads it; then it ends.
  void define(std::uint32_t value) { defines_.push_back(value); }
  void read(std::uint32_t value) { reads_.push_back(value); }
  void end() { ends_.push_back({defines_.size(), reads_.size()}); }
  // Numbers that a value consists of; 1 unless said.
  void set_width(std::uint32_t value, std::uint8_t width) { widths_[value] = width; }

 private:
  friend class RegisterPlanner;
  struct End {
    std::size_t defines, reads;  // before it, of all steps
  };
  std::vector<std::uint8_t> widths_;
  std::vector<std::uint32_t> defines_, reads_;
  std::vector<End> ends_;
};

struct RegisterPlan {
  static constexpr std::uint32_t kNoSlot = 0xffffffffU;

  std::vector<std::uint32_t> slot;  // of a computed value: its place in the array, if it goes there
  std::vector<std::vector<std::uint32_t>> leaving;  // after each step: what is in no register now
  std::uint32_t size = 0;                           // numbers in the array
};

// `registers`: values held at a time. What lies in memory anyway is held only from one reader to
// the next one that is no more than `longest` steps away.
RegisterPlan plan_registers(const RegisterSteps& steps, std::uint32_t registers,
                            std::uint32_t longest);

}  // namespace sinew::backend
