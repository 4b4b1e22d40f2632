// Rights and writers from models in a graph, with `w:` = https://w3id.org/sinew/world#
//
//   C a w:Component ;  w:writes M ; w:reads M         C will write, or read, the measurement M
//   R a w:Allowance ;  w:who C ; w:act A ; w:what X   a rule that allows
//   R a w:Prohibition; w:who C ; w:act A ; w:what X   a rule that forbids
//
//   R a w:SingleWriter;           w:what X             nobody but one component may say that it
//   writes
//
// A is "write-measurement", "change-relation", "change-model", "read-measurement", "read-graph" or
// "perform-action"; X is the IRI of an element of the world, of an action, of a graph
// (w:UnnamedGraph among them), or w:Anything. Rules may
// name several C, and several X.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/world/rights.h"

namespace sinew::world {

// A component says that it will read a measurement.
struct DeclaredReader {
  std::string who, what;  // IRIs
  Place place = {};
};

struct DeclaredRights {
  Rights rights;
  std::vector<DeclaredWriter> writers;
  std::vector<DeclaredReader> readers;
  std::set<std::string> components;  // IRIs
  struct Named {
    std::string who, rule;  // IRIs
    Place place = {};
  };
  std::vector<Named> named;  // whom rules are about
};

// What is wrong is in the report, with its place; the rest is in the result.
DeclaredRights read_rights(graph::Store& store, const graph::Places& places, Report& report);

// Finds what cannot work together (rights.h), and of reading:
//   error    a reader of what is no measurement of this world; one that is none of its users; a
//            user, or somebody whom a rule names, that is no declared component
void check_configuration(const World& world, const DeclaredRights& declared, Report& report);

}  // namespace sinew::world
