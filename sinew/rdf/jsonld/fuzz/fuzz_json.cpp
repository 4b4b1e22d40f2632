// The JSON reader: any bytes give a value or an Error, and what is written reads back equal.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/rdf/json/reader.h"
#include "sinew/rdf/json/writer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew;
  try {
    const json::Document document =
        json::read({reinterpret_cast<const char*>(data), size}, "fuzz.json");
    const json::Document plain = json::read(json::to_text(document.root), "written");
    if (!json::equal(document.root, plain.root)) std::abort();
    const json::Document pretty = json::read(json::to_pretty_text(document.root, 40), "pretty");
    if (!json::equal(document.root, pretty.root)) std::abort();
    // Numbers beyond the range of a double have no canonical form.
    const std::string canonical = json::to_canonical_text(document.root);
    if (canonical.find("inf") == std::string::npos) json::read(canonical, "canonical");
  } catch (const Error& error) {
    if (error.problems().front().place.line == 0) std::abort();
  }
  return 0;
}
