// What the world wants of whatever lies in its graph, as a domain (graph/domain.h): a relative pose
// is of one frame and with respect to one, a property is of one; a measurement measures one
// relation and has one quantity; an object is attached to one frame.
//
//   Report report;
//   graph::check(world.graph().view(), world_domain(world.graph().terms()), places, report);
//
// What a world describes always conforms. Models that lie beside it, and what actions have led to,
// need not.
#pragma once

#include "sinew/graph/domain.h"

namespace sinew::world {

graph::Domain world_domain(graph::Terms& terms);

}  // namespace sinew::world
