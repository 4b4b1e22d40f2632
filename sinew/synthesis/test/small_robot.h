// A small robot for tests: a base with two limbs.
//
//   base --one(revolute)--> A --two(revolute)--> B --three(prismatic)--> C
//                           A --four(revolute)--> D
//
// Frames are NAME-frame; "tool" is fixed to C. All IRIs start with https://example.org/.
#pragma once

#include <string>

#include "sinew/graph/store.h"
#include "sinew/model/tree.h"

namespace sinew::synthesis {

inline graph::Id example(graph::Store& store, const std::string& name) {
  return store.terms().iri("https://example.org/" + name);
}

// Writes the normalised tree of the robot into the store.
void write_small_robot(graph::Store& store);

}  // namespace sinew::synthesis
