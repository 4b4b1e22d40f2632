#include "sinew/backend/c_flat_zeros.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "sinew/backend/zero_blocks.h"

namespace sinew::backend {
namespace {

// Fewer zeros than this are written one by one.
constexpr std::uint32_t kLeastZeros = 4;

// `row`: "row + ", or nothing.
void write_run(CodeBlock& code, const ZeroStyle& style, const std::string& indent,
               const std::string& row, const ZeroRun& run) {
  if (run.size >= kLeastZeros) {
    code.add(fmt::format("{}memset({} + {}{}, 0, {} * sizeof *{});", indent, style.array, row,
                         run.first, run.size, style.array));
    return;
  }
  for (std::uint32_t k = run.first; k < run.first + run.size; ++k) {
    code.add(fmt::format("{}{}[{}{}] = {};", indent, style.array, row, k, style.number));
  }
}

}  // namespace

void write_zeros(CodeBlock& code, CNames& given, const ZeroStyle& style,
                 std::span<const std::uint32_t> places) {
  std::vector<std::uint32_t> sorted(places.begin(), places.end());
  std::sort(sorted.begin(), sorted.end());
  const Zeros zeros = arrange_zeros(sorted);
  for (const ZeroBlock& block : zeros.blocks) {
    const std::string row = given.unique("row");
    const std::uint32_t first = block.runs.front().first;
    code.add(fmt::format("  for (size_t {0} = {1}; {0} != {2}; {0} += {3}) {{", row, first,
                         first + block.rows * block.stride, block.stride));
    // What a compiler knows nothing of it does not unroll. It may not look like a pointer to the
    // results: they would be taken for something that others point to.
    code.add(fmt::format("    {}_AGAIN({});", style.prefix, row));
    for (const ZeroRun& run : block.runs) {
      write_run(code, style, "    ", row + " + ", {run.first - first, run.size});
    }
    code.add("  }");
  }
  for (const ZeroRun& run : zeros.single) write_run(code, style, "  ", "", run);
}

}  // namespace sinew::backend
