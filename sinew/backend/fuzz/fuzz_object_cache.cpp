// Any bytes as a file of the cache: an object comes out of it only where the file is, byte for
// byte, what is written for that object under that name. The first byte says whether the rest is
// such a file already, or the object of one, of which then a single byte is changed.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "sinew/backend/jit/object_cache.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew::backend;
  constexpr std::string_view kName = "a.o";
  if (size < 2) return 0;
  std::string file(reinterpret_cast<const char*>(data) + 1, size - 1);
  if ((data[0] & 1U) != 0) {
    const std::string object = file;
    file = sealed(kName, object);
    if (unsealed(kName, file) != object) std::abort();
    file[data[0] % file.size()] ^= static_cast<char>(data[1] | 1U);
    if (!unsealed(kName, file).empty()) std::abort();
    return 0;
  }
  const std::string object(unsealed(kName, file));
  if (!object.empty() && file != sealed(kName, object)) std::abort();
  if (!object.empty() && !unsealed("b.o", file).empty()) std::abort();
  return 0;
}
