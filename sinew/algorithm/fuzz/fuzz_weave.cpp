// Any text as an update of an algorithm: it is woven in and the result reads back without a fault,
// or it is refused and the algorithm stays as it was.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "sinew/algorithm/read.h"
#include "sinew/algorithm/test/composition.h"
#include "sinew/algorithm/weave.h"
#include "sinew/base/error.h"

namespace {

using namespace sinew;

// Prefixes of what an update speaks of, so that mutations need not invent them.
constexpr const char* kPrefixes =
    "PREFIX sa: <https://w3id.org/sinew/algorithm#>\n"
    "PREFIX so: <https://w3id.org/sinew/operators#>\n"
    "PREFIX algo: <https://comp-rob2b.github.io/metamodels/algorithm#>\n"
    "PREFIX rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#>\n"
    "PREFIX ex: <https://example.org/>\n";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  algorithm::Composition composition;
  const std::size_t before = composition.store.view().size();
  const std::string text(reinterpret_cast<const char*>(data), size);
  bool woven = false;
  try {
    algorithm::weave(composition.store, composition.algorithm, kPrefixes + text, "fuzz.rq");
    woven = true;
  } catch (const Error&) {  // an answer too
  }
  // Throws, and so ends the run, where what weave() let through is at fault.
  algorithm::read_checked(composition.store.view(), composition.algorithm);
  if (!woven && composition.store.view().size() != before) {
    std::fprintf(stderr, "a refused update has changed the algorithm\n");
    std::abort();
  }
  return 0;
}
