// Triggers that a scene declares: shown, and watched while values are written.
#pragma once

#include <optional>

#include "world_scene.h"

namespace sinew::cli {

// A line for each.
void show_triggers(const LoadedScene& scene);

struct WatchOptions {
  std::optional<double> until_s;  // looked at until then, after the last value
  double step_s = 0.1;            // between two looks
};
inline constexpr std::size_t kMaximumLooks = 1'000'000;

// Writes the values in the order of their times, looks after all of one time, and prints what
// happens: when, which trigger, how often, for whom, and the action that whoever runs the scene
// would have bound to it. Relations that hold are facts at each look. Throws Error as load_world.
int watch(const SceneOptions& options, const WatchOptions& watch);

}  // namespace sinew::cli
