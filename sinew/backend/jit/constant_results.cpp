#include "sinew/backend/jit/constant_results.h"

#include <algorithm>
#include <cstddef>

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
      : builder_(builder), number_(number), out_(out), results_(results) {}

  // The neighbours first..last: whole vectors, the last one overlapping the one before it.
  void run(std::size_t first, std::size_t last) const {
    std::size_t width = kWidestBytes / bytes_of(number_);
    while (width > last - first) width /= 2;
    for (std::size_t at = first; at < last; at += width) store(std::min(at, last - width), width);
  }

 private:
  void store(std::size_t first, std::size_t width) const {
    std::vector<LLVMValueRef> numbers;
    for (std::size_t i = first; i < first + width; ++i)
      numbers.push_back(LLVMConstReal(number_, *results_[i]));
    const LLVMValueRef value = width == 1
                                   ? numbers.front()
                                   : LLVMConstVector(numbers.data(), static_cast<unsigned>(width));
    LLVMValueRef offset =
        LLVMConstInt(LLVMInt64TypeInContext(LLVMGetTypeContext(number_)), first, false);
    const LLVMValueRef place = LLVMBuildInBoundsGEP2(builder_, number_, out_, &offset, 1, "");
    LLVMSetAlignment(LLVMBuildStore(builder_, value, place),
                     static_cast<unsigned>(bytes_of(number_)));
  }

  LLVMBuilderRef builder_;
  LLVMTypeRef number_;
  LLVMValueRef out_;
  const std::vector<std::optional<double>>& results_;
};

}  // namespace

void store_constant_results(LLVMBuilderRef builder, LLVMTypeRef number, LLVMValueRef out,
                            const std::vector<std::optional<double>>& results) {
  const Writer writer(builder, number, out, results);
  for (std::size_t first = 0; first < results.size();) {
    std::size_t last = first;
    while (last < results.size() && results[last]) ++last;
    if (last > first) writer.run(first, last);
    first = last + 1;
  }
}

}  // namespace sinew::backend
