// A part on a table, seen by a camera, for certain users only.
#pragma once

#include <string>
#include <vector>

#include "sinew/world/world.h"
#include "times_and_places.h"

namespace sinew::world {

inline const std::string kTask = "http://x/task", kCamera = "http://x/camera",
                         kOther = "http://x/other", kSeen = "http://x/seen";

// base -(constant)-> table -(seen, for the users)-> part
struct SeenPart {
  explicit SeenPart(std::vector<std::string> users) {
    base = world.add_frame("http://x/base");
    table = world.add_frame("http://x/table");
    part = world.add_frame("http://x/part");
    world.add_static("http://x/standing", table, base, {{}, {0, 0, 1}}, "http://x/me");
    lying = world.add_relation({.name = "http://x/lying", .of = part, .with_respect_to = table});
    seen = world.add_measurement({.name = kSeen,
                                  .relation = lying,
                                  .model = {.provenance = kCamera, .used_by = std::move(users)},
                                  .keep_all = true});
    world.write(seen, at_s(1), Pose{{}, {1, 0, 0}}, {kCamera});
  }
  PoseQuery query() const { return {.of = part, .with_respect_to = base}; }
  World world;
  FrameId base, table, part;
  RelationId lying;
  MeasurementId seen;
};

}  // namespace sinew::world
