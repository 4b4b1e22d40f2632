#include "sinew/backend/jit/row_addresses.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "sinew/backend/jit/ir.h"

namespace sinew::backend {
namespace {

constexpr std::size_t kMultiples[] = {1, 3, 5};
constexpr std::size_t kScales[] = {1, 2, 4, 8};
constexpr std::size_t kFarthest = 40;
// Steps that move a pointer; beyond, a multiplication and an addition do.
constexpr int kMostSteps = 3;
// Rows that a new pointer is chosen for.
constexpr std::size_t kAhead = 16;

struct Step {
  std::size_t distance = 0, scale = 0;  // no scale: not in one step
};

Step step_of(std::size_t rows) {
  for (std::size_t k = 0; k < std::size(kMultiples); ++k) {
    for (const std::size_t scale : kScales) {
      if (kMultiples[k] * scale == rows) return {k, scale};
    }
  }
  return {};
}

LLVMValueRef add_bytes(LLVMBuilderRef builder, LLVMValueRef pointer, LLVMValueRef bytes) {
  const LLVMTypeRef byte = LLVMInt8TypeInContext(LLVMGetTypeContext(LLVMTypeOf(bytes)));
  return LLVMBuildGEP2(builder, byte, pointer, &bytes, 1, "");
}

LLVMValueRef times(LLVMBuilderRef builder, LLVMValueRef a, std::size_t factor) {
  return LLVMBuildMul(builder, a, LLVMConstInt(LLVMTypeOf(a), factor, false), "");
}

}  // namespace

RowDistances::RowDistances(LLVMBuilderRef builder, LLVMValueRef bytes) : builder_(builder) {
  distances_[0] = hidden(builder, bytes);
  for (std::size_t k = 1; k < std::size(kMultiples); ++k) {
    distances_[k] = hidden(builder, times(builder, distances_[0], kMultiples[k]));
  }
}

bool RowDistances::reaches(std::size_t rows) const { return rows == 0 || step_of(rows).scale != 0; }

LLVMValueRef RowDistances::move(LLVMValueRef pointer, std::size_t rows) const {
  if (rows == 0) return pointer;
  const Step step = step_of(rows);
  return add_bytes(builder_, pointer, times(builder_, distances_[step.distance], step.scale));
}

LLVMValueRef RowDistances::move_far(LLVMValueRef pointer, std::size_t rows) const {
  for (int step = 0; step < kMostSteps && rows <= kMostSteps * kFarthest; ++step) {
    if (reaches(rows)) return hidden(builder_, move(pointer, rows));
    std::size_t next = std::min(rows, kFarthest);
    while (!reaches(next)) --next;
    pointer = hidden(builder_, move(pointer, next));
    rows -= next;
  }
  // Of a hidden factor, or LLVM would keep the product in a register for others.
  const LLVMValueRef bytes = times(builder_, hidden(builder_, distances_[0]), rows);
  return hidden(builder_, add_bytes(builder_, pointer, bytes));
}

RowAddresses::RowAddresses(LLVMBuilderRef builder, const RowDistances& distances,
                           LLVMValueRef array, std::vector<std::uint32_t> rows,
                           std::size_t pointers)
    : distances_(distances),
      builder_(builder),
      array_(array),
      rows_(std::move(rows)),
      most_(pointers) {
  pointers_.push_back({array, 0, 0});
}

bool RowAddresses::is_reached(std::size_t row, std::size_t from) const {
  return row >= from && distances_.reaches(row - from);
}

// How many of those that are needed next.
std::size_t RowAddresses::reached_from(std::size_t row) const {
  const std::size_t end = std::min(at_ + kAhead, rows_.size());
  std::size_t count = 0;
  for (std::size_t k = at_; k < end; ++k) count += is_reached(rows_[k], row) ? 1 : 0;
  return count;
}

// One from which this row is in reach, and as many of the next ones as possible; in one instruction
// if there is one.
RowAddresses::Pointer RowAddresses::make_pointer(std::size_t row) const {
  const Pointer* from = nullptr;
  std::size_t best = row, most = 0;
  for (std::size_t to = row > kFarthest ? row - kFarthest : 0; to <= row; ++to) {
    if (!is_reached(row, to)) continue;
    const auto near = std::find_if(pointers_.begin(), pointers_.end(), [&](const Pointer& pointer) {
      return is_reached(to, pointer.row);
    });
    const bool is_near = near != pointers_.end();
    const std::size_t count = reached_from(to);
    if (from != nullptr && !is_near) continue;
    if (is_near == (from != nullptr) && count <= most) continue;
    from = is_near ? &*near : nullptr;
    best = to;
    most = count;
  }
  if (from == nullptr) return {distances_.move_far(array_, best), best, 0};
  return {hidden(builder_, distances_.move(from->value, best - from->row)), best, 0};
}

RowAddresses::Pointer& RowAddresses::pointer_for(std::size_t row) {
  const auto found = std::find_if(pointers_.begin(), pointers_.end(), [&](const Pointer& pointer) {
    return is_reached(row, pointer.row);
  });
  if (found != pointers_.end()) return *found;
  const Pointer made = make_pointer(row);
  if (pointers_.size() < most_) return pointers_.emplace_back(made);
  Pointer& oldest =
      *std::min_element(pointers_.begin(), pointers_.end(),
                        [](const Pointer& a, const Pointer& b) { return a.used < b.used; });
  return oldest = made;
}

LLVMValueRef RowAddresses::of(std::uint32_t row) {
  const std::size_t end = std::min(at_ + kAhead, rows_.size());
  for (std::size_t k = at_; k < end; ++k) {
    if (rows_[k] != row) continue;
    at_ = k;
    break;
  }
  Pointer& pointer = pointer_for(row);
  pointer.used = ++time_;
  return distances_.move(pointer.value, row - pointer.row);
}

}  // namespace sinew::backend
