// Which links and frames are fixed to each other, by constant poses and fixed joints, and where
// each frame then is in its body.
#pragma once

#include <optional>
#include <vector>

#include "sinew/graph/terms.h"
#include "sinew/model/structure.h"

namespace sinew::model {

// How far two ways to the same frame may differ [m, and entries of the rotation].
constexpr double kConsistencyTolerance = 1e-6;

struct RigidBodies {
  struct Edge {
    int to = kNone;       // frame
    Pose pose;            // of it in the frame whose edge this is
    Id source;            // the coordinates or the fixed joint that says so
    bool forward = true;  // false: `pose` is the inverse of what the source says
  };

  int count = 0;
  std::vector<int> of_frame, of_link;           // body
  std::vector<std::vector<int>> frames, links;  // of each body, in order of appearance
  std::vector<std::vector<Edge>> edges;         // of each frame
};

RigidBodies find_rigid_bodies(const Structure& structure);

// The pose of every frame of a body, from that of one: `poses` is indexed like Structure::frames
// and filled in. Two ways to a frame that disagree are an error.
void place_frames(const Structure& structure, const RigidBodies& bodies, const graph::Terms& terms,
                  const graph::Places& places, int frame, const Pose& pose,
                  std::vector<std::optional<Pose>>& poses, Report& report);

}  // namespace sinew::model
