#include "round_trip.h"

// The first byte chooses between Turtle and TriG.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew::rdf;
  if (size == 0) return 0;
  fuzz::round_trip({reinterpret_cast<const char*>(data) + 1, size - 1},
                   data[0] % 2 == 0 ? Syntax::kTurtle : Syntax::kTriG);
  return 0;
}
