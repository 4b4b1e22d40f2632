// The quantities that rules of qualitative.h are made of, one function each, in a table.
#pragma once

#include <span>
#include <vector>

#include "sinew/world/qualitative.h"

namespace sinew::world {

// A body seen along the rule's axes.
struct Seen {
  std::vector<Shape> shapes;
  Vector3 origin;  // of its frame
  Bounds3 box;     // of all shapes

  Vector3 centre() const { return 0.5 * (box.minimum + box.maximum); }
};
Seen see(const Pose& X_axes_space, const Space& space, BodyId body);

// Precondition: `index` is one of quantities(), and `third` is not null for a ternary one.
double measure(std::size_t index, const Seen& first, const Seen& second, const Seen* third);

}  // namespace sinew::world
