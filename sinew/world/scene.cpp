#include "sinew/world/scene.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <unordered_map>

#include "sinew/model/structure.h"
#include "sinew/vocab/vocab.h"
#include "sinew/world/edit.h"
#include "sinew/world/reading.h"
#include "sinew/world/scene_measurements.h"
#include "sinew/world/scene_numbers.h"

namespace sinew::world {
namespace {

using graph::Id;

struct SceneReader {
  World& world;
  graph::Store& store;
  model::GraphReader& reader;
  SceneNumbers numbers;
  model::Structure structure;
  const SceneReading& options;
  Edit edit;
  std::unordered_map<Id, const model::Structure::ConstantPose*> by_coordinate;
  std::unordered_map<Id, std::vector<const model::Structure::ConstantPose*>> by_relation;

  Id w(std::string_view term) { return numbers.w(term); }
  std::string text(Id id) { return std::string(reader.text(id)); }

  FrameId frame(Id iri) {
    const FrameId there = edit.find_frame(reader.text(iri));
    return there ? there : edit.add_frame(reader.text(iri));
  }

  // What an edit refuses is a fault of the node that asked for it.
  template <typename Do>
  void attempt(Id node, Do&& act) {
    try {
      act();
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) {
        reader.error(node, {},
                     (problem.iri == reader.text(node) ? "" : problem.iri + ": ") + problem.what,
                     problem.remedy);
      }
    }
  }

  // ---- values ----

  struct Value {
    Pose pose;
    Stamp stamp;
  };
  std::optional<Value> value(Id node, Id stated, FrameId of, FrameId with_respect_to) {
    if (const auto found = by_coordinate.find(stated); found != by_coordinate.end()) {
      const auto& pose = *found->second;
      if (frame(structure.frames[static_cast<std::size_t>(pose.of)].iri) != of ||
          frame(structure.frames[static_cast<std::size_t>(pose.with_respect_to)].iri) !=
              with_respect_to) {
        reader.error(node, {}, "its coordinates are those of another relation",
                     "coordinates of the relation that is measured");
        return std::nullopt;
      }
      return Value{from_matrix(pose.pose), Stamp()};
    }
    if (!reader.is_a(stated, w("PoseValue"))) {
      reader.error(node, w("value"), text(stated) + " are no coordinates of a pose",
                   "a PoseValue, or a PoseCoordinate of the relation that is measured");
      return std::nullopt;
    }
    const auto seen_by = reader.one(stated, reader.ids.seen_by, "the frame that sees the pose");
    const auto pose = numbers.pose(stated, true);
    const auto stamp = numbers.stamp(stated);
    if (!seen_by || !pose || !stamp) return std::nullopt;
    if (edit.find_frame(reader.text(*seen_by)) != with_respect_to) {
      reader.error(stated, reader.ids.seen_by, "the pose is seen by " + text(*seen_by),
                   "by the frame with respect to which it is");
      return std::nullopt;
    }
    return Value{*pose, *stamp};
  }

  struct Entry {
    std::vector<double> numbers;
    Stamp stamp;
  };
  std::optional<Entry> entry(Id node, Id stated, const Measured& measured) {
    if (measured.quantity == Quantity::kPose) {
      const auto pose = value(node, stated, measured.of, measured.with_respect_to);
      if (!pose) return std::nullopt;
      Entry result{std::vector<double>(7), pose->stamp};
      store_pose(pose->pose, result.numbers.data());
      return result;
    }
    if (!reader.is_a(stated, w("Numbers"))) {
      reader.error(node, w("value"),
                   text(stated) + " is no value of a " + std::string(to_string(measured.quantity)),
                   "a Numbers");
      return std::nullopt;
    }
    auto found = numbers.si_list(stated, "numbers", measured.size);
    const auto stamp = numbers.stamp(stated);
    if (!found || !stamp) return std::nullopt;
    if (measured.quantity == Quantity::kTwist || measured.quantity == Quantity::kAcceleration) {
      const auto seen_by = reader.one(stated, reader.ids.seen_by, "the frame that sees the motion");
      if (!seen_by) return std::nullopt;
      if (edit.find_frame(reader.text(*seen_by)) != measured.of) {
        reader.error(stated, reader.ids.seen_by, "the motion is seen by " + text(*seen_by),
                     "by the frame that moves");
        return std::nullopt;
      }
    }
    return Entry{std::move(*found), *stamp};
  }

  // ---- data blocks ----

  std::optional<std::string> optional_text(Id node, std::string_view term) {
    const Id found = reader.view.object(node, w(term));
    return found ? std::optional(text(found)) : std::nullopt;
  }
  bool is_true(Id node, std::string_view term) {
    const auto stated = optional_text(node, term);
    return stated == "true" || stated == "1";
  }

  std::optional<BlocksSpec> blocks(Id node) {
    BlocksSpec spec;
    if (!numbers.has(node, "blocks")) return spec;
    const auto library = reader.one(node, w("library"), "the library of the data blocks");
    if (!library) return std::nullopt;
    if (!options.read_library) {
      reader.error(node, w("library"), "data blocks, and nobody here reads their library",
                   "SceneReading::read_library");
      return std::nullopt;
    }
    spec.library_text = text(*library);
    spec.canonical = optional_text(node, "canonical").value_or("");
    bool whole = true;
    attempt(node, [&] { spec.library = options.read_library(spec.library_text); });
    Id at = reader.view.object(node, w("blocks"));
    for (; at && at != reader.ids.nil && spec.blocks.size() <= kMaximumBlocksOfMeasurement;
         at = reader.view.object(at, reader.ids.rest)) {
      const Id block = reader.view.object(at, reader.ids.first);
      const auto prototype = reader.one(block, w("prototype"), "the prototype of the data block");
      whole = whole && prototype.has_value();
      if (!prototype) continue;
      spec.blocks.push_back({.name = text(block),
                             .prototype = text(*prototype),
                             .realtime = is_true(block, "realtime"),
                             .allow_lossy = is_true(block, "allows-lossy")});
    }
    if (!whole || !spec.library) return std::nullopt;
    return spec;
  }

  void set(MeasurementId measurement, const Value& value) {
    double values[7];
    store_pose(value.pose, values);
    edit.set_value(measurement, value.stamp, values);
  }

  // A value of the relation itself: constant, and the model's.
  void constant(Id node, const std::string& name, RelationId relation, const Value& value) {
    attempt(node, [&] {
      set(edit.add_measurement(
              {.name = name,
               .relation = relation,
               .model = {.life_cycle = Static{}, .provenance = std::string(kModelProvenance)},
               .capacity = 1}),
          value);
    });
  }

  void measurement(Id node, RelationId relation, FrameId of, FrameId with_respect_to) {
    const auto measured = read_measured(numbers, node, of, with_respect_to);
    if (!measured) return;
    auto model = read_measurement_model(numbers, edit, node, *measured);
    if (!model) return;
    const bool is_static = std::holds_alternative<Static>(model->life_cycle);
    const auto capacity = read_entries(numbers, node, is_static);
    auto data_blocks = blocks(node);
    if (!capacity || !data_blocks) return;
    const Id stated = reader.view.object(node, w("value"));
    if (is_static && !stated) {
      reader.warning(node, w("value"), "is static and has no value",
                     "state its value; until it is written, no pose leads over it");
    }
    const auto first = stated ? entry(node, stated, *measured) : std::nullopt;
    attempt(node, [&] {
      const MeasurementId made = edit.add_measurement({.name = reader.text(node),
                                                       .relation = relation,
                                                       .quantity = measured->quantity,
                                                       .model = std::move(*model),
                                                       .capacity = *capacity,
                                                       .values = measured->size,
                                                       .keep_all = is_true(node, "keeps-all"),
                                                       .blocks = std::move(*data_blocks)});
      if (first) edit.set_value(made, first->stamp, first->numbers);
    });
  }

  // The joint's frame, of a relation that is a joint.
  std::optional<Pose> placement(Id node, FrameId with_respect_to) {
    const auto stated = reader.one(node, w("placement"), "the pose of the joint's frame");
    if (!stated) return std::nullopt;
    const auto found = value(node, *stated, {}, with_respect_to);
    return found ? std::optional(found->pose) : std::nullopt;
  }

  void property(Id node) {
    const Id of = reader.view.object(node, reader.ids.of);
    if (!of || !reader.is_a(of, reader.ids.frame)) {
      reader.error(node, reader.ids.of, "a property of " + (of ? text(of) : "nothing"),
                   "of a Frame of these models");
      return;
    }
    attempt(node, [&] {
      const RelationId made = edit.add_relation({.name = reader.text(node),
                                                 .of = frame(of),
                                                 .with_respect_to = {},
                                                 .kind = RelationKind::kProperty});
      for (const Id measured : reader.objects(node, w("measured-by"))) {
        measurement(measured, made, frame(of), {});
      }
    });
  }

  void relation(Id node) {
    const Id of = reader.view.object(node, reader.ids.of);
    const Id to = reader.view.object(node, reader.ids.with_respect_to);
    const std::vector<Id> measurements = reader.objects(node, w("measured-by"));
    const Id stated = reader.view.object(node, w("value"));
    if (!reader.is_a(of, reader.ids.frame) || !reader.is_a(to, reader.ids.frame)) {
      // Poses of links and simplices are other modules' business, unless somebody measures them.
      if (!measurements.empty() || stated) {
        const bool of_frame = reader.is_a(of, reader.ids.frame);
        reader.error(
            node, of_frame ? reader.ids.with_respect_to : reader.ids.of,
            "a pose that is not between two frames: " +
                (of_frame ? (to ? text(to) : "with-respect-to")
                 : of     ? text(of)
                          : "of") +
                (of_frame ? (to ? " is none" : " is missing") : (of ? " is none" : " is missing")),
            "of, and with-respect-to: each a Frame of these models");
      }
      return;
    }
    const FrameId frame_of = frame(of), frame_to = frame(to);
    attempt(node, [&] {
      RelationSpec spec{.name = reader.text(node), .of = frame_of, .with_respect_to = frame_to};
      const bool turns = reader.is_a(node, w("Revolute"));
      if (turns || reader.is_a(node, w("Prismatic"))) {
        const auto where = placement(node, frame_to);
        if (!where) return;
        spec.kind = turns ? RelationKind::kRevolute : RelationKind::kPrismatic;
        spec.placement = *where;
      }
      const RelationId made = edit.add_relation(spec);
      const Id suspended = reader.view.object(node, w("suspended"));
      const bool is_attachment = reader.is_a(node, w("Attachment"));
      if (is_attachment || suspended) {
        edit.set_attachment(made, is_attachment, suspended && reader.text(suspended) == "true");
      }
      for (const Id measured : measurements) measurement(measured, made, frame_of, frame_to);
      if (stated) {
        const auto first = value(node, stated, frame_of, frame_to);
        if (first) constant(node, text(node) + "/value", made, *first);
      }
      if (!measurements.empty() || stated) return;
      for (const auto* pose : by_relation[node]) {
        constant(node, text(pose->coordinate) + "/value", made, {from_matrix(pose->pose), Stamp()});
      }
    });
  }

  void object(Id node) {
    const auto to = reader.one(node, w("attached-to"), "the frame that the object is attached to");
    if (!to) return;
    if (!reader.is_a(*to, reader.ids.frame) && !edit.find_frame(reader.text(*to))) {
      reader.error(node, w("attached-to"), "is attached to " + text(*to) + ", which is no frame",
                   "a Frame of these models");
      return;
    }
    const Id model = reader.view.object(node, w("instance-of"));
    attempt(node, [&] {
      edit.add_object(reader.text(node), frame(*to), model ? reader.text(model) : "");
    });
  }

  void run() {
    for (const auto& pose : structure.poses) {
      by_coordinate[pose.coordinate] = &pose;
      const Id relation = reader.view.object(pose.coordinate, reader.ids.of_pose);
      if (relation) by_relation[relation].push_back(&pose);
    }
    for (const Id node : reader.all(reader.ids.frame)) frame(node);
    for (const Id node : reader.all(store.terms().iri(vocab::geom_rel::Pose))) relation(node);
    for (const Id node : reader.all(w("Property"))) property(node);
    for (const Id node : reader.all(w("Object"))) object(node);
  }
};

}  // namespace

void load_scene(World& world, graph::Store& store, const graph::Places& places, Report& report,
                const SceneReading& options) {
  model::GraphReader reader(store, places, report);
  SceneReader scene{.world = world,
                    .store = store,
                    .reader = reader,
                    .numbers = {reader, store},
                    .structure = model::read_structure(store, places, report),
                    .options = options,
                    .edit = world.edit(),
                    .by_coordinate = {},
                    .by_relation = {}};
  if (report.has_errors()) return;
  scene.run();
  if (!report.has_errors()) scene.edit.commit();
}

}  // namespace sinew::world
