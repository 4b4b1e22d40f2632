// A motion that is asked for between any two frames: of F with respect to G, seen by H.
#pragma once

#include <string>
#include <vector>

#include "sinew/synthesis/query.h"
#include "sinew/synthesis/robot.h"

namespace sinew::synthesis {

struct Relation {
  Id node = {};  // stands for the three frames
  Id of = {}, with_respect_to = {}, seen_by = {};
  std::string label = {};     // "F.wrt.G.seen-by.H", what is not asked left out
  std::string quantity = {};  // a row of asked.cpp
};

// From one question that has a single frame F. Error when a frame is not there, or seen_by does not
// fit the quantity.
Relation relation_of(graph::Store& store, const graph::View& view, const Robot& robot,
                     const Asked& asked, Id frame);

// The joints whose motion moves one of the two frames with respect to the other, and the body from
// which both can be reached over these alone.
struct WayBetween {
  Id base_frame;                              // the last body frame on the way to both
  std::vector<std::size_t> to_one, to_other;  // joints from there, indices into Robot::joints
};
WayBetween way_between(const Robot& robot, const graph::View& view, Id one, Id other);

// The body to which a frame is fixed.
Id body_of(const Robot& robot, const graph::View& view, Id frame);

}  // namespace sinew::synthesis
