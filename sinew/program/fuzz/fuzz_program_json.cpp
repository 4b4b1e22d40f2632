// Whatever the bytes: a program or an Error, and a program can be written and read again.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/program/program_json.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const sinew::program::Program program = sinew::program::from_json(text, "fuzz");
    const std::string written = to_json(program);
    if (to_json(sinew::program::from_json(written, "again")) != written) std::abort();
  } catch (const sinew::Error&) {  // an answer too
  }
  return 0;
}
