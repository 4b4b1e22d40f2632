// Whatever the bytes: a text or an Error.
#include <cstdint>
#include <string_view>

#include "sinew/backend/render.h"
#include "sinew/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using sinew::backend::Fields;
  Fields item, fields;
  item.text("b", "inner");
  fields.text("a", "text");
  fields.text("b", "outer");
  fields.section("c", true);
  fields.section("d", false);
  fields.list("e", {item});
  fields.list("f", {});
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    static_cast<void>(sinew::backend::fill_template("fuzz", text, fields));
  } catch (const sinew::Error&) {  // an answer too
  }
  return 0;
}
