#include "sinew/world/scene.h"

#include <cmath>
#include <optional>
#include <unordered_map>

#include "sinew/model/graph_reader.h"
#include "sinew/model/structure.h"
#include "sinew/world/edit.h"
#include "sinew/world/reading.h"
#include "sinew/world/symbols.h"

namespace sinew::world {
namespace {

using graph::Id;

constexpr data::Dimension kTime = {{0, 0, 1}};

struct SceneReader {
  World& world;
  graph::Store& store;
  model::GraphReader reader;
  model::Structure structure;
  Edit edit;
  std::unordered_map<Id, const model::Structure::ConstantPose*> by_coordinate;

  Id w(std::string_view term) {
    return store.terms().iri(std::string(kWorldNamespace) + std::string(term));
  }
  std::string text(Id id) { return std::string(reader.text(id)); }

  FrameId frame(Id iri) {
    const FrameId there = edit.find_frame(reader.text(iri));
    return there ? there : edit.add_frame(reader.text(iri));
  }

  // A property whose value is a node with a number and a unit of time.
  std::optional<Duration> duration(Id node, Id property) {
    const Id value = reader.view.object(node, property);
    if (!value) return kForever;
    const auto number = reader.number(value, w("number"));
    const auto scale = reader.scale(value, kTime, "the duration");
    if (!number || !scale) return std::nullopt;
    return duration_of_seconds(*number * *scale);
  }

  std::optional<LifeCycle> life_cycle(Id node) {
    const auto kind = reader.one(node, w("life-cycle"), "how long the measurement holds");
    const auto validity = duration(node, w("validity"));
    if (!kind || !validity) return std::nullopt;
    if (reader.text(*kind) == "static") return Static{};
    if (reader.text(*kind) == "time-dependent") return TimeDependent{.validity = *validity};
    reader.error(node, w("life-cycle"), "there is no life-cycle '" + text(*kind) + "' in models",
                 "static or time-dependent; predictions are declared in code");
    return std::nullopt;
  }

  std::vector<std::string> texts(Id node, Id property) {
    std::vector<std::string> result;
    for (const Id object : reader.objects(node, property)) result.push_back(text(object));
    return result;
  }

  void measurement(Id node, RelationId relation, FrameId of, FrameId with_respect_to) {
    const auto cycle = life_cycle(node);
    const auto period = duration(node, w("period"));
    const auto provenance = reader.one(node, w("provenance"), "who provides the measurement");
    if (!cycle || !period || !provenance) return;
    MeasurementModel model{.life_cycle = *cycle,
                           .provenance = text(*provenance),
                           .used_by = texts(node, w("used-by")),
                           .period = *period};
    if (const Id seen_from = reader.view.object(node, w("coord-frame"))) {
      model.coord_frame = text(seen_from);
    }
    const bool is_static = std::holds_alternative<Static>(*cycle);
    const MeasurementId made = edit.add_measurement({.name = reader.text(node),
                                                     .relation = relation,
                                                     .model = std::move(model),
                                                     .capacity = is_static ? 1 : kUsualCapacity});
    const Id value = reader.view.object(node, w("value"));
    if (!value) return;
    const auto found = by_coordinate.find(value);
    if (found == by_coordinate.end()) {
      reader.error(node, w("value"), text(value) + " are no coordinates of a pose",
                   "a PoseCoordinate of the relation that is measured");
      return;
    }
    set(made, *found->second, of, with_respect_to, node);
  }

  void set(MeasurementId made, const model::Structure::ConstantPose& pose, FrameId of,
           FrameId with_respect_to, Id node) {
    const FrameId pose_of = frame(structure.frames[static_cast<std::size_t>(pose.of)].iri);
    const FrameId pose_to =
        frame(structure.frames[static_cast<std::size_t>(pose.with_respect_to)].iri);
    if (pose_of != of || pose_to != with_respect_to) {
      reader.error(node, {}, "its coordinates are those of another relation",
                   "coordinates of the relation that is measured");
      return;
    }
    double values[7];
    store_pose(from_matrix(pose.pose), values);
    edit.set_value(made, Stamp(), values);
  }

  void relation(Id node) {
    const Id of = reader.view.object(node, reader.ids.of);
    const Id to = reader.view.object(node, reader.ids.with_respect_to);
    if (!reader.is_a(of, reader.ids.frame) || !reader.is_a(to, reader.ids.frame)) return;
    const FrameId frame_of = frame(of), frame_to = frame(to);
    const RelationId made =
        edit.add_relation({.name = reader.text(node), .of = frame_of, .with_respect_to = frame_to});
    const std::vector<Id> measurements = reader.objects(node, w("measured-by"));
    for (const Id measured : measurements) measurement(measured, made, frame_of, frame_to);
    if (!measurements.empty()) return;
    for (const auto& [coordinate, pose] : by_coordinate) {
      if (reader.view.object(coordinate, reader.ids.of_pose) != node) continue;
      const MeasurementId constant = edit.add_measurement(
          {.name = text(coordinate) + "/value",
           .relation = made,
           .model = {.life_cycle = Static{}, .provenance = std::string(kModelProvenance)},
           .capacity = 1});
      set(constant, *pose, frame_of, frame_to, node);
    }
  }

  void object(Id node) {
    const auto to = reader.one(node, w("attached-to"), "the frame that the object is attached to");
    if (!to) return;
    const Id model = reader.view.object(node, w("instance-of"));
    edit.add_object(reader.text(node), frame(*to), model ? reader.text(model) : "");
  }

  void run() {
    for (const auto& pose : structure.poses) by_coordinate[pose.coordinate] = &pose;
    for (const Id node : reader.all(reader.ids.frame)) frame(node);
    for (const Id node : reader.all(store.terms().iri(vocab::geom_rel::Pose))) relation(node);
    for (const Id node : reader.all(w("Object"))) object(node);
  }
};

}  // namespace

void load_scene(World& world, graph::Store& store, const graph::Places& places, Report& report) {
  SceneReader scene{.world = world,
                    .store = store,
                    .reader = model::GraphReader(store, places, report),
                    .structure = model::read_structure(store, places, report),
                    .edit = world.edit(),
                    .by_coordinate = {}};
  if (report.has_errors()) return;
  scene.run();
  if (!report.has_errors()) scene.edit.commit();
}

}  // namespace sinew::world
