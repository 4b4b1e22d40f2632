// The smallest algorithm that an update can work on: it composes X_AB and X_BD to X_AD.
#pragma once

#include <string>
#include <string_view>

#include "sinew/algorithm/builder.h"
#include "sinew/graph/store.h"

namespace sinew::algorithm {

struct Composition {
  graph::Store store;
  graph::Id algorithm = iri("algorithm");

  Composition() {
    graph::Transaction transaction = store.begin();
    Builder builder(store, transaction, algorithm);
    const graph::Id A = iri("A"), B = iri("B"), D = iri("D");
    const auto in = [&](std::string_view slot, graph::Id of, graph::Id wrt) {
      return builder.block({.slot = slot,
                            .represents = of,
                            .quantity = "pose",
                            .of = of,
                            .wrt = wrt,
                            .role = Role::kInput});
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

}  // namespace sinew::algorithm
