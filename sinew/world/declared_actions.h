// Actions from models in a graph, with `w:` = https://w3id.org/sinew/world#
//
//   A a w:Action ; w:parameter P… ; w:effect "update" ;
//     w:precondition [ w:query "ASK or SELECT" ; w:message "why not, with {x}" ]… ;
//     w:attaches "SELECT ?frame ?parent …" ; w:detaches "SELECT ?frame ?parent …" ;
//     w:adds "SELECT ?object ?frame ?model …" ; w:removes "SELECT ?object …"
//
// The texts are SPARQL (action_effects.h); preconditions are judged in the order of their messages.
#pragma once

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/world/action_effects.h"

namespace sinew::world {

// Faults are in the report, each with its place; an action with one is left out.
void read_actions(graph::Store& store, const graph::Places& places, Actions& actions,
                  Report& report);

}  // namespace sinew::world
