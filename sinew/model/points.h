// Where the points of a body are: the origins of its frames, and what positions say of others.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "sinew/model/rigid_bodies.h"

namespace sinew::model {

// By body and point, seen from the body's frame.
using Points = std::map<std::pair<int, Id>, Vector3>;

// The points of all bodies whose frames have a place (`poses`, indexed like Structure::frames):
// from the origins of frames along positions, in either direction, that a frame of the body sees. A
// point that is at two places is an error.
Points place_points(const Structure& structure, const RigidBodies& bodies,
                    const std::vector<std::optional<Pose>>& poses, const graph::Terms& terms,
                    const graph::Places& places, Report& report);

}  // namespace sinew::model
