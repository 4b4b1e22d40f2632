#include "sinew/backend/jit/block_memory.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "sinew/backend/jit/ir.h"

namespace sinew::backend {
namespace {

// An address has one byte: so many lie to either side of a pointer.
constexpr std::size_t kNear = 128;
// Pointers to vectors; each takes a register.
constexpr std::size_t kMostPointers = 3;

LLVMValueRef integer(LLVMTypeRef type, std::ptrdiff_t value) {
  return LLVMConstInt(LLVMInt64TypeInContext(LLVMGetTypeContext(type)),
                      static_cast<unsigned long long>(value), true);
}

LLVMValueRef offset(LLVMBuilderRef builder, LLVMTypeRef type, LLVMValueRef pointer,
                    std::ptrdiff_t count) {
  LLVMValueRef by = integer(type, count);
  return LLVMBuildGEP2(builder, type, pointer, &by, 1, "");
}

}  // namespace

BlockMemory::BlockMemory(const Place& place, LLVMTypeRef type, std::size_t angles,
                         std::size_t waiting)
    : place_(place),
      type_(type),
      number_(LLVMGetElementType(type)),
      angles_(angles),
      size_(2 * angles + waiting) {
  if (size_ == 0) return;
  array_ = Ir(place_.builder, type_, false).entry_array(place_.function, size_);
  LLVMSetAlignment(array_, 64);
}

void BlockMemory::begin() {
  for (std::size_t at = 0; at < size_ && pointers_.size() < kMostPointers; at += 2 * kNear) {
    const std::size_t middle = at + std::min(kNear, size_ - at);
    pointers_.push_back(hidden(place_.builder, offset(place_.builder, type_, array_,
                                                      static_cast<std::ptrdiff_t>(middle))));
  }
}

LLVMValueRef BlockMemory::address(std::size_t at) const {
  const std::size_t k = std::min(at / (2 * kNear), pointers_.size() - 1);
  const std::size_t first = 2 * kNear * k;
  const std::size_t middle = first + std::min(kNear, size_ - first);
  return offset(place_.builder, type_, pointers_[k],
                static_cast<std::ptrdiff_t>(at) - static_cast<std::ptrdiff_t>(middle));
}

LLVMValueRef BlockMemory::load_at(std::size_t at) const {
  const LLVMValueRef value = LLVMBuildLoad2(place_.builder, type_, address(at), "");
  LLVMSetAlignment(value, 64);
  LLVMSetVolatile(value, true);
  return value;
}

void BlockMemory::keep(LLVMValueRef value, std::size_t slot) const {
  const LLVMValueRef store = LLVMBuildStore(place_.builder, value, address(2 * angles_ + slot));
  LLVMSetAlignment(store, 64);
  LLVMSetVolatile(store, true);
}

// The table is filled in the order of use, and the pointer moves on when its end is out of reach.
LLVMValueRef BlockMemory::constant(double value) {
  const auto is_it = [&](double other) {
    return std::bit_cast<std::uint64_t>(other) == std::bit_cast<std::uint64_t>(value);
  };
  const auto found = std::find_if(constants_.begin() + static_cast<std::ptrdiff_t>(window_),
                                  constants_.end(), is_it);
  const auto at = static_cast<std::size_t>(found - constants_.begin());
  if (found == constants_.end()) constants_.push_back(value);
  if (table_ == nullptr || at >= window_ + 2 * kNear) {
    if (table_ == nullptr) {
      table_ = LLVMAddGlobal(LLVMGetGlobalParent(place_.function), number_, "constants_begin");
    }
    window_ = at;
    table_pointer_ = hidden(place_.builder, offset(place_.builder, number_, table_,
                                                   static_cast<std::ptrdiff_t>(window_ + kNear)));
  }
  const LLVMValueRef lane = LLVMBuildLoad2(
      place_.builder, number_,
      offset(place_.builder, number_, table_pointer_,
             static_cast<std::ptrdiff_t>(at) - static_cast<std::ptrdiff_t>(window_ + kNear)),
      "");
  LLVMSetVolatile(lane, true);
  return Ir(place_.builder, type_, false).in_every_lane(lane);
}

void BlockMemory::end() {
  if (table_ == nullptr) return;
  std::vector<LLVMValueRef> numbers;
  for (const double value : constants_) numbers.push_back(LLVMConstReal(number_, value));
  constexpr unsigned kLine = 64;
  LLVMSetAlignment(become_table(table_, numbers, "constants"), kLine);
}

}  // namespace sinew::backend
