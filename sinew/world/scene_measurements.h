// What a scene's models say of a measurement (scene.h has the terms): what is measured, how long it
// holds, who provides it, how much of it is kept. All functions have reported why when there is
// nothing in what they return.
#pragma once

#include <cstdint>
#include <optional>

#include "sinew/world/edit.h"
#include "sinew/world/life_cycle.h"
#include "sinew/world/scene_numbers.h"
#include "sinew/world/state.h"

namespace sinew::world {

struct Measured {  // what a measurement is of
  Quantity quantity = Quantity::kPose;
  std::uint32_t size = 7;
  FrameId of, with_respect_to;
};

// Of a relation of one frame with respect to another, or of a property of one frame.
std::optional<Measured> read_measured(SceneNumbers& numbers, graph::Id node, FrameId of,
                                      FrameId with_respect_to);
// The frames that it names are those of the edit.
std::optional<MeasurementModel> read_measurement_model(SceneNumbers& numbers, const Edit& edit,
                                                       graph::Id node, const Measured& measured);
std::optional<std::uint32_t> read_entries(SceneNumbers& numbers, graph::Id node, bool is_static);

}  // namespace sinew::world
