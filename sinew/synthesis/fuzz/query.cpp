// Any text as a query model or a sweep configuration: read as JSON-LD, or refused with its faults.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sinew/synthesis/read_query.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew;
  static const catalogue::Catalogue catalogue;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    synthesis::canonical_text(synthesis::parse_query(text, "fuzz.json", catalogue));
  } catch (const Error&) {  // an answer too
  }
  try {
    synthesis::parse_sweeps(text, "fuzz.json", catalogue);
  } catch (const Error&) {  // an answer too
  }
  return 0;
}
