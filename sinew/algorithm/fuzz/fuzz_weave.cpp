// Any text as an update of an algorithm: it is woven in and the result reads back without a fault,
// or it is refused and the algorithm stays as it was.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "sinew/algorithm/builder.h"
#include "sinew/algorithm/read.h"
#include "sinew/algorithm/weave.h"
#include "sinew/base/error.h"

namespace {

using namespace sinew;

// Composes X_AB and X_BD to X_AD.
struct Composition {
  graph::Store store;
  graph::Id algorithm = iri("algorithm");

  Composition() {
    graph::Transaction transaction = store.begin();
    algorithm::Builder builder(store, transaction, algorithm);
    const graph::Id A = iri("A"), B = iri("B"), D = iri("D");
    const auto in = [&](const char* slot, graph::Id of, graph::Id wrt) {
      return builder.block({.slot = slot,
                            .represents = of,
                            .quantity = "pose",
                            .of = of,
                            .wrt = wrt,
                            .role = algorithm::Role::kInput});
    };
    const auto out =
        builder.block({.slot = "X_AD", .represents = D, .quantity = "pose", .of = D, .wrt = A});
    builder.closure("compose-pose", {in("X_AB", B, A), in("X_BD", D, B), out}, {});
    builder.output(out);
    builder.finish();
    transaction.commit();
  }
  graph::Id iri(const std::string& name) {
    return store.terms().iri("https://example.org/" + name);
  }
};

// Prefixes of what an update speaks of, so that mutations need not invent them.
constexpr const char* kPrefixes =
    "PREFIX sa: <https://w3id.org/sinew/algorithm#>\n"
    "PREFIX so: <https://w3id.org/sinew/operators#>\n"
    "PREFIX algo: <https://comp-rob2b.github.io/metamodels/algorithm#>\n"
    "PREFIX rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#>\n"
    "PREFIX ex: <https://example.org/>\n";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Composition composition;
  const std::size_t before = composition.store.view().size();
  const std::string text(reinterpret_cast<const char*>(data), size);
  bool woven = false;
  try {
    algorithm::weave(composition.store, composition.algorithm, kPrefixes + text, "fuzz.rq");
    woven = true;
  } catch (const Error&) {
  }
  // Throws, and so ends the run, where what weave() let through is at fault.
  algorithm::read_checked(composition.store.view(), composition.algorithm);
  if (!woven && composition.store.view().size() != before) {
    std::fprintf(stderr, "a refused update has changed the algorithm\n");
    std::abort();
  }
  return 0;
}
