#include "round_trip.h"

// The first byte chooses between N-Triples and N-Quads.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew::rdf;
  if (size == 0) return 0;
  fuzz::round_trip({reinterpret_cast<const char*>(data) + 1, size - 1},
                   data[0] % 2 == 0 ? Syntax::kNTriples : Syntax::kNQuads);
  return 0;
}
