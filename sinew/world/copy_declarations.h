// What models declare beside the scene and the world never changes, taken over into a scene that is
// written (scene.h): components, what they write and read, rights, and actions, as they are said.
#pragma once

#include <cstddef>

#include "sinew/graph/store.h"

namespace sinew::world {

// Every triple of a w:Component, w:Allowance, w:Prohibition, w:SingleWriter and w:Action, and of
// the blank nodes that these lead to; into the unnamed graph of `to`. Returns how many.
std::size_t copy_declarations(const graph::Store& from, graph::Store& to);

}  // namespace sinew::world
