// The normalised tree as a model of MuJoCo's (MJCF): the same joints, placements and inertias that
// the solvers are made from.
#pragma once

#include <string>

#include "sinew/graph/terms.h"
#include "sinew/model/tree.h"
#include "sinew/robot/scene.h"

namespace sinew::robot {

// Of the object until it is grasped [kg, kg m^2]: MuJoCo has no way to add a body later.
inline constexpr double kNoMass = 1e-9;

// Joints are called by their IRIs, bodies "body 0", "body 1", ... as in the tree; "tool", "table"
// and "object" are geoms and a body of those names, "hand" a site. Throws Error: a frame that the
// model does not have, a moving body without mass.
std::string mjcf(const model::Tree& tree, const graph::Terms& terms, const Scene& scene,
                 double timestep);

// Its placement in a body, by IRI or last segment; throws Error.
const model::Tree::Frame& find_frame(const model::Tree& tree, const graph::Terms& terms,
                                     const std::string& name);

}  // namespace sinew::robot
