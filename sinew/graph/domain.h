// What a domain wants of the nodes in a graph: which types there are, and with how many of what
// each is well-formed. A relative pose has one frame that it is of and one with respect to which it
// is; a vector has a start and an end. Entities may have no roles at all.
//
// A domain is data. Checking asks for no order in which the graph was made.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"

namespace sinew::graph {

struct Role {
  Id property;                      // from the node to the argument
  Id filler;                        // type of the argument; 0: any
  std::size_t least = 1, most = 1;  // how many
};

struct DomainType {
  Id type;
  std::vector<Role> roles = {};
};

struct Domain {
  std::string name;
  std::vector<DomainType> types;
};

// For each node of one of the domain's types, an error for each role with too few or too many
// arguments, and for each argument of another type. Matches the union of all graphs. In the order
// of types, nodes by their text, roles.
void check(const View& view, const Domain& domain, const Places& places, Report& report);

}  // namespace sinew::graph
