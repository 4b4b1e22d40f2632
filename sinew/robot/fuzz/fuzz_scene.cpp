// Any text as a scene: it is read, or refused with an Error.
#include <cstdint>

#include "sinew/base/error.h"
#include "sinew/robot/scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    sinew::robot::parse_scene({reinterpret_cast<const char*>(data), size}, "scene.json");
  } catch (const sinew::Error&) {  // an answer too
  }
  return 0;
}
