// Rights and writers from models in a graph, with `w:` = https://w3id.org/sinew/world#
//
//   C a w:Component ;  w:writes M                     C will write the measurement M
//   R a w:Allowance ;  w:who C ; w:act A ; w:what X   a rule that allows
//   R a w:Prohibition; w:who C ; w:act A ; w:what X   a rule that forbids
//
// A is "write-measurement", "change-relation" or "change-model"; X is the IRI of an element of the
// world, or w:Anything. Rules may name several C, and several X.
#pragma once

#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/world/rights.h"

namespace sinew::world {

struct DeclaredRights {
  Rights rights;
  std::vector<DeclaredWriter> writers;
};

// What is wrong is in the report, with its place; the rest is in the result.
DeclaredRights read_rights(graph::Store& store, const graph::Places& places, Report& report);

}  // namespace sinew::world
