// Numbers of scene models: lists, vectors and poses, each checked and in SI units. All functions
// that return an optional have reported why when there is nothing in it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/model/graph_reader.h"
#include "sinew/world/clock.h"
#include "sinew/world/pose.h"
#include "sinew/world/symbols.h"

namespace sinew::world {

inline constexpr data::Dimension kTimeDimension = {{0, 0, 1}};

// The reader of a model with the terms of scenes.
struct SceneNumbers {
  model::GraphReader& reader;
  graph::Store& store;

  graph::Id w(std::string_view term) {
    return store.terms().iri(std::string(kWorldNamespace) + std::string(term));
  }
  std::string text(graph::Id id) const { return std::string(reader.text(id)); }
  bool has(graph::Id node, std::string_view term) { return reader.has(node, w(term)); }

  // A list of exactly `count` finite numbers.
  std::optional<std::vector<double>> list(graph::Id node, graph::Id property, std::size_t count);
  // The same in the order of a quantity and in SI units, which is said (w:system).
  std::optional<std::vector<double>> si_list(graph::Id node, std::string_view term,
                                             std::size_t count);
  std::optional<Vector3> vector(graph::Id node, graph::Id property);
  // A list of lists of two numbers, `most` of them at most.
  std::optional<std::vector<std::array<double, 2>>> corners(graph::Id node, graph::Id property,
                                                            std::size_t most);
  // w:position [length] and w:quaternion; each must be there when it is `required`, and is zero
  // (no rotation) where it is neither there nor required.
  std::optional<Pose> pose(graph::Id node, bool required);
  // What a property's node, with w:number and a unit, says in seconds. kForever where there is no
  // such property.
  std::optional<Duration> duration(graph::Id node, std::string_view term);
  // w:stamp, to the nanosecond where it is an integer of nanoseconds; the beginning of the clock
  // where there is none.
  std::optional<Stamp> stamp(graph::Id node, std::string_view term = "stamp");
};

}  // namespace sinew::world
