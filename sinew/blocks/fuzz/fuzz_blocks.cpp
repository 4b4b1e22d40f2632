// Any text is either refused with an Error, or read; what is read is formatted, read again as the
// same, taken into the graph and back, and checked. Files that import others are only formatted: a
// fuzzer opens no files.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sinew/blocks/elaborate.h"
#include "sinew/blocks/format.h"
#include "sinew/blocks/graph.h"
#include "sinew/blocks/parser.h"

namespace {

using namespace sinew;

bool imports(const blocks::Node& node) {
  for (const blocks::Node& child : node.children) {
    if (child.kind == "import" || imports(child)) return true;
  }
  return false;
}

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  blocks::Node tree;
  try {
    tree = blocks::parse(text, "fuzz.blocks");
  } catch (const Error&) {
    return 0;
  }
  const std::string once = blocks::format(tree);
  require(blocks::format(blocks::parse(once, "fuzz.blocks")) == once);
  try {
    graph::Store store;
    const auto id = blocks::to_graph(tree, "https://example.org/", store);
    // References are shortened on the way, so one more round has to change nothing.
    const blocks::Node back = blocks::from_graph(store.view(), id, "fuzz.blocks");
    graph::Store again;
    const auto second = blocks::to_graph(back, "https://example.org/", again);
    require(blocks::format(blocks::from_graph(again.view(), second, "fuzz.blocks")) ==
            blocks::format(back));
  } catch (const Error&) {  // an answer too
  }
  if (imports(tree)) return 0;
  try {
    data::make_library(blocks::elaborate(tree), {});
  } catch (const Error&) {  // an answer too
  }
  return 0;
}
