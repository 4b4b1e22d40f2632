#include "sinew/backend/jit/constant_rows.h"

#include <bit>
#include <cstddef>
#include <cstdint>

#include "sinew/backend/jit/ir.h"

namespace sinew::backend {
namespace {

// Fewer are written one by one.
constexpr std::size_t kShortestLoop = 3;

class ConstantRows {
 public:
  ConstantRows(const Place& place, LLVMTypeRef type, LLVMValueRef out,
               const RowDistances& distances)
      : builder_(place.builder),
        function_(place.function),
        type_(type),
        distances_(distances),
        pointer_(out) {}

  // In ascending order.
  void write(double value, std::size_t first, std::size_t count) {
    pointer_ = distances_.move_far(pointer_, first - row_);
    row_ = first;
    const LLVMValueRef numbers = Ir(builder_, type_, false).number(value);
    if (count >= kShortestLoop) return loop(numbers, count);
    for (std::size_t k = 0; k < count; ++k) store(numbers, distances_.move(pointer_, k));
  }

 private:
  void store(LLVMValueRef numbers, LLVMValueRef address) const {
    LLVMSetAlignment(LLVMBuildStore(builder_, numbers, address),
                     bytes_of(LLVMGetElementType(type_)));
  }

  void loop(LLVMValueRef numbers, std::size_t count) {
    const LLVMContextRef context = LLVMGetTypeContext(type_);
    const LLVMValueRef end = distances_.move_far(pointer_, count);
    LLVMBasicBlockRef before = LLVMGetInsertBlock(builder_);
    LLVMBasicBlockRef inside = LLVMAppendBasicBlockInContext(context, function_, "");
    const LLVMBasicBlockRef after = LLVMAppendBasicBlockInContext(context, function_, "");
    LLVMBuildBr(builder_, inside);
    LLVMPositionBuilderAtEnd(builder_, inside);
    const LLVMValueRef at = LLVMBuildPhi(builder_, LLVMTypeOf(pointer_), "");
    store(numbers, at);
    LLVMValueRef next = distances_.move(at, 1);
    LLVMAddIncoming(at, &pointer_, &before, 1);
    LLVMAddIncoming(at, &next, &inside, 1);
    LLVMBuildCondBr(builder_, LLVMBuildICmp(builder_, LLVMIntNE, next, end, ""), inside, after);
    LLVMPositionBuilderAtEnd(builder_, after);
    pointer_ = end;
    row_ += count;
  }

  LLVMBuilderRef builder_;
  LLVMValueRef function_;
  LLVMTypeRef type_;
  const RowDistances& distances_;
  LLVMValueRef pointer_;
  std::size_t row_ = 0;  // that it points to
};

bool is_same(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b && std::bit_cast<std::uint64_t>(*a) == std::bit_cast<std::uint64_t>(*b);
}

}  // namespace

void store_constant_rows(const Place& place, LLVMTypeRef type, LLVMValueRef out,
                         const RowDistances& distances,
                         const std::vector<std::optional<double>>& results) {
  ConstantRows rows(place, type, out, distances);
  for (std::size_t first = 0; first < results.size();) {
    std::size_t end = first + 1;
    while (end < results.size() && is_same(results[first], results[end])) ++end;
    if (results[first]) rows.write(*results[first], first, end - first);
    first = end;
  }
}

}  // namespace sinew::backend
