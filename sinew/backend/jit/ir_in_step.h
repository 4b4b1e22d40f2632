// The arithmetic of ir.h on several values at a time, operation by operation: chains of operations
// that wait for themselves are written side by side.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sinew/backend/jit/ir.h"

namespace sinew::backend {

class IrInStep {
 public:
  using Values = std::vector<LLVMValueRef>;

  IrInStep(const Ir& ir, std::size_t n) : ir_(ir), n_(n) {}

  bool fuses() const { return ir_.fuses(); }
  Values number(double value) const {
    return each([&](std::size_t) { return ir_.number(value); });
  }
  Values add(const Values& a, const Values& b) const {
    return each([&](std::size_t k) { return ir_.add(a[k], b[k]); });
  }
  Values subtract(const Values& a, const Values& b) const {
    return each([&](std::size_t k) { return ir_.subtract(a[k], b[k]); });
  }
  Values multiply(const Values& a, const Values& b) const {
    return each([&](std::size_t k) { return ir_.multiply(a[k], b[k]); });
  }
  Values negate(const Values& a) const {
    return each([&](std::size_t k) { return ir_.negate(a[k]); });
  }
  Values multiply_add(const Values& a, const Values& b, const Values& c) const {
    return each([&](std::size_t k) { return ir_.multiply_add(a[k], b[k], c[k]); });
  }
  Values select(const Values& mask, const Values& if_true, const Values& if_false) const {
    return each([&](std::size_t k) { return ir_.select(mask[k], if_true[k], if_false[k]); });
  }
  Values to_integer_bits(const Values& a) const {
    return each([&](std::size_t k) { return ir_.to_integer_bits(a[k]); });
  }
  Values add_integer(const Values& bits, std::uint64_t value) const {
    return each([&](std::size_t k) { return ir_.add_integer(bits[k], value); });
  }
  Values bit_is_set(const Values& bits, unsigned bit) const {
    return each([&](std::size_t k) { return ir_.bit_is_set(bits[k], bit); });
  }
  Values shift_left(const Values& bits, unsigned places) const {
    return each([&](std::size_t k) { return ir_.shift_left(bits[k], places); });
  }
  Values flip_sign(const Values& a, const Values& bits) const {
    return each([&](std::size_t k) { return ir_.flip_sign(a[k], bits[k]); });
  }

 private:
  template <typename Make>
  Values each(Make&& make) const {
    Values values(n_);
    for (std::size_t k = 0; k < n_; ++k) values[k] = make(k);
    return values;
  }

  const Ir& ir_;
  std::size_t n_;
};

}  // namespace sinew::backend
