// How far a robot reaches: the collision geometry that its models have (URDF's, imported), as the
// shapes of the frames that see it. For a world into which the robot was loaded (robot.h).
#pragma once

#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/world/declared_scene.h"
#include "sinew/world/mesh_file.h"
#include "sinew/world/world.h"

namespace sinew::world {

// A body for each frame that has such geometry, in the order in which the models say it. What
// cannot be taken over, a mesh without a file that is found among it, is a warning with its place,
// and left out.
std::vector<DeclaredBody> read_robot_shapes(const World& world, graph::Store& store,
                                            const graph::Places& places, Report& report,
                                            const MeshFiles& meshes = {});

}  // namespace sinew::world
