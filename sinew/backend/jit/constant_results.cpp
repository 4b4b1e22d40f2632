#include "sinew/backend/jit/constant_results.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "sinew/backend/zero_blocks.h"

namespace sinew::backend {
namespace {

constexpr std::size_t kWidestBytes = 64;

std::size_t bytes_of(LLVMTypeRef number) {
  return LLVMGetTypeKind(number) == LLVMFloatTypeKind ? 4 : 8;
}

class Writer {
 public:
  Writer(LLVMBuilderRef builder, LLVMTypeRef number, LLVMValueRef out,
         const std::vector<std::optional<double>>& results)
      : builder_(builder),
        number_(number),
        out_(out),
        results_(results),
        integer_(LLVMInt64TypeInContext(LLVMGetTypeContext(number))) {}

  // A loop over the rows.
  void block(const ZeroBlock& block) const {
    const LLVMContextRef context = LLVMGetTypeContext(number_);
    const LLVMBasicBlockRef before = LLVMGetInsertBlock(builder_);
    const LLVMValueRef function = LLVMGetBasicBlockParent(before);
    const LLVMBasicBlockRef loop = LLVMAppendBasicBlockInContext(context, function, "");
    const LLVMBasicBlockRef after = LLVMAppendBasicBlockInContext(context, function, "");
    const std::size_t first = block.runs.front().first;
    LLVMValueRef begin = place(out_, first);
    const LLVMValueRef end = place(out_, first + std::size_t{block.rows} * block.stride);
    LLVMBuildBr(builder_, loop);
    LLVMPositionBuilderAtEnd(builder_, loop);
    const LLVMValueRef row = LLVMBuildPhi(builder_, LLVMTypeOf(out_), "");
    for (const ZeroRun& run : block.runs) {
      const std::size_t from = run.first - first;
      for_each_store(from, from + run.size, [&](std::size_t at, std::size_t width) {
        store(row, at, std::vector<double>(width, 0.0));
      });
    }
    LLVMValueRef next = place(row, block.stride);
    LLVMBasicBlockRef from_loop = loop, from_before = before;
    LLVMAddIncoming(row, &begin, &from_before, 1);
    LLVMAddIncoming(row, &next, &from_loop, 1);
    LLVMBuildCondBr(builder_, LLVMBuildICmp(builder_, LLVMIntNE, next, end, ""), loop, after);
    LLVMPositionBuilderAtEnd(builder_, after);
  }

  // The neighbours first..last.
  void run(std::size_t first, std::size_t last) const {
    for_each_store(first, last, [&](std::size_t at, std::size_t width) {
      std::vector<double> numbers;
      for (std::size_t i = at; i < at + width; ++i) numbers.push_back(*results_[i]);
      store(out_, at, numbers);
    });
  }

 private:
  // Whole vectors, the last one overlapping the one before it.
  template <typename Store>
  void for_each_store(std::size_t first, std::size_t last, Store store) const {
    std::size_t width = kWidestBytes / bytes_of(number_);
    while (width > last - first) width /= 2;
    for (std::size_t at = first; at < last; at += width) store(std::min(at, last - width), width);
  }

  LLVMValueRef place(LLVMValueRef from, std::size_t distance) const {
    LLVMValueRef offset = LLVMConstInt(integer_, distance, false);
    return LLVMBuildInBoundsGEP2(builder_, number_, from, &offset, 1, "");
  }

  void store(LLVMValueRef from, std::size_t distance, const std::vector<double>& numbers) const {
    std::vector<LLVMValueRef> values;
    for (const double number : numbers) values.push_back(LLVMConstReal(number_, number));
    const LLVMValueRef value =
        values.size() == 1 ? values.front()
                           : LLVMConstVector(values.data(), static_cast<unsigned>(values.size()));
    LLVMSetAlignment(LLVMBuildStore(builder_, value, place(from, distance)),
                     static_cast<unsigned>(bytes_of(number_)));
  }

  LLVMBuilderRef builder_;
  LLVMTypeRef number_;
  LLVMValueRef out_;
  const std::vector<std::optional<double>>& results_;
  LLVMTypeRef integer_;
};

}  // namespace

void store_constant_results(LLVMBuilderRef builder, LLVMTypeRef number, LLVMValueRef out,
                            const std::vector<std::optional<double>>& results) {
  const Writer writer(builder, number, out, results);
  std::vector<std::uint32_t> zeros;
  for (std::uint32_t i = 0; i < results.size(); ++i) {
    if (results[i] == 0.0) zeros.push_back(i);
  }
  std::vector<bool> is_done(results.size(), false);
  for (const ZeroBlock& block : arrange_zeros(zeros).blocks) {
    writer.block(block);
    for_each_place(block, [&](std::size_t place) { is_done[place] = true; });
  }
  const auto is_left = [&](std::size_t i) { return results[i].has_value() && !is_done[i]; };
  for (std::size_t first = 0; first < results.size();) {
    std::size_t last = first;
    while (last < results.size() && is_left(last)) ++last;
    if (last > first) writer.run(first, last);
    first = last + 1;
  }
}

}  // namespace sinew::backend
