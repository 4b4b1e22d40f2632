// A long straight-line function as steps that compute values and read them: what is asked when one
// plans which of them wait in memory (kept_values.h, jit/register_plan.h). Internal to `backend`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::backend {

class ValueSteps {
 public:
  explicit ValueSteps(std::uint32_t values) : widths_(values, 1) {}

  // The present step computes this value, or reads it, whoever has computed it; then it ends.
  void define(std::uint32_t value) { defines_.push_back(value); }
  void read(std::uint32_t value) { reads_.push_back(value); }
  void end() { ends_.push_back({defines_.size(), reads_.size()}); }
  // Numbers that a value consists of; 1 unless said.
  void set_width(std::uint32_t value, std::uint8_t width) { widths_[value] = width; }

  std::uint32_t values() const { return static_cast<std::uint32_t>(widths_.size()); }
  std::uint32_t width(std::uint32_t value) const { return widths_[value]; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(ends_.size()); }
  std::span<const std::uint32_t> defines() const { return defines_; }  // of all steps
  std::span<const std::uint32_t> defines(std::uint32_t step) const;
  std::span<const std::uint32_t> reads(std::uint32_t step) const;

 private:
  struct End {
    std::size_t defines, reads;  // before it, of all steps
  };
  End begin_of(std::uint32_t step) const { return step == 0 ? End{0, 0} : ends_[step - 1]; }

  std::vector<std::uint32_t> widths_;
  std::vector<std::uint32_t> defines_, reads_;
  std::vector<End> ends_;
};

// The steps that read each value, and how far one has come.
class Readers {
 public:
  explicit Readers(const ValueSteps& steps);

  bool is_read_later(std::uint32_t value) const { return next_[value] < end_[value]; }
  std::uint32_t next(std::uint32_t value) const { return readers_[next_[value]]; }
  // What lies behind this step is still to come.
  void pass(std::uint32_t value, std::uint32_t step) {
    while (is_read_later(value) && next(value) <= step) ++next_[value];
  }

 private:
  std::vector<std::uint32_t> readers_;     // steps, one value's after the other's
  std::vector<std::uint32_t> next_, end_;  // of each value, in readers_
};

inline constexpr std::uint32_t kNoSlot = 0xffffffffU;

// How often a value is written to memory and read there, and the step that does so last.
struct SlotUse {
  std::uint32_t count = 0, last = 0;
};

// Gives the values whose slot is not kNoSlot their places in an array. Values that are not there
// at the same time share one; the places that are used most lie first, where the shortest addresses
// reach. Returns the array's numbers.
std::uint32_t share_slots(const ValueSteps& steps, std::span<const SlotUse> uses,
                          std::span<std::uint32_t> slot);

}  // namespace sinew::backend
