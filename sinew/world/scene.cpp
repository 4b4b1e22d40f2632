#include "sinew/world/scene.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <unordered_map>

#include "sinew/model/structure.h"
#include "sinew/vocab/vocab.h"
#include "sinew/world/edit.h"
#include "sinew/world/reading.h"
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

  // ---- what is known of a measurement ----

  // Numbers in the order of a quantity and in SI units, which is said.
  std::optional<std::vector<double>> si_numbers(Id node, std::string_view term, std::size_t size) {
    const auto system = reader.one(node, w("system"), "the system of units");
    auto found = numbers.list(node, w(term), size);
    if (!system || !found) return std::nullopt;
    if (reader.text(*system) == "SI") return found;
    reader.error(node, w("system"), "there is no system of units '" + text(*system) + "'", "SI");
    return std::nullopt;
  }

  // A twist, or how it changes.
  std::optional<Twist> twist(Id node, std::string_view angular_term, std::string_view linear_term,
                             const data::Dimension& of_angles, const data::Dimension& of_lengths) {
    const auto angular = numbers.vector(node, w(angular_term));
    const auto linear = numbers.vector(node, w(linear_term));
    const auto angles = reader.scale(node, of_angles, "the angular motion");
    const auto lengths = reader.scale(node, of_lengths, "the linear motion");
    if (!angular || !linear || !angles || !lengths) return std::nullopt;
    return Twist{*angles * *angular, *lengths * *linear};
  }
  std::optional<Twist> velocity(Id node) {
    return twist(node, "angular", "linear", model::dimension::kAngularVelocity,
                 model::dimension::kVelocity);
  }

  struct Measured {  // what a measurement is of
    Quantity quantity = Quantity::kPose;
    std::uint32_t size = 7;
    FrameId of, with_respect_to;
  };

  std::optional<PredictionModel> prediction(Id node, const Measured& measured) {
    const FrameId with_respect_to = measured.with_respect_to;
    const auto model = reader.one(node, w("predicted-by"), "the model of a prediction");
    if (!model) return std::nullopt;
    const bool of_pose = measured.quantity == Quantity::kPose;
    if (reader.is_a(*model, w("ConstantVelocity"))) {
      ConstantVelocity constant;
      if (numbers.has(*model, "angular") || numbers.has(*model, "linear")) {
        const auto stated = velocity(*model);
        if (!stated) return std::nullopt;
        constant.twist = *stated;
      }
      if (numbers.has(*model, "rates")) {
        auto rates = si_numbers(*model, "rates", measured.size);
        if (!rates) return std::nullopt;
        constant.rates = std::move(*rates);
      }
      return constant;
    }
    if (reader.is_a(*model, w("ConstantAcceleration"))) {
      ConstantAcceleration faster;
      if (of_pose) {
        const auto stated = velocity(*model);
        const auto rate =
            twist(*model, "angular-rate", "linear-rate", model::dimension::kAngularAcceleration,
                  model::dimension::kAcceleration);
        if (!stated || !rate) return std::nullopt;
        faster.twist = *stated;
        faster.twist_rate = *rate;
        return faster;
      }
      auto rates = si_numbers(*model, "rates", measured.size);
      auto accelerations = si_numbers(*model, "accelerations", measured.size);
      if (!rates || !accelerations) return std::nullopt;
      faster.rates = std::move(*rates);
      faster.accelerations = std::move(*accelerations);
      return faster;
    }
    if (reader.is_a(*model, w("Conveyor"))) {
      const auto linear = numbers.vector(*model, w("linear"));
      const auto scale =
          reader.scale(*model, model::dimension::kVelocity, "the conveyor's velocity");
      const auto seen_by = reader.one(*model, reader.ids.seen_by, "the frame of the velocity");
      if (!linear || !scale || !seen_by) return std::nullopt;
      if (edit.find_frame(reader.text(*seen_by)) != with_respect_to) {
        reader.error(*model, reader.ids.seen_by, "the velocity is seen by " + text(*seen_by),
                     "by the frame with respect to which the pose is measured");
        return std::nullopt;
      }
      return Conveyor{*scale * *linear};
    }
    reader.error(node, w("predicted-by"), text(*model) + " is no model of prediction",
                 "a ConstantVelocity, a ConstantAcceleration or a Conveyor; others are in code");
    return std::nullopt;
  }

  std::optional<LifeCycle> life_cycle(Id node, const Measured& measured) {
    const auto kind = reader.one(node, w("life-cycle"), "how long the measurement holds");
    const auto validity = numbers.duration(node, "validity");
    const auto horizon = numbers.duration(node, "horizon");
    const auto expiry = numbers.stamp(node, "expiry");
    if (!kind || !validity || !horizon || !expiry) return std::nullopt;
    if (reader.text(*kind) != "prediction" &&
        (numbers.has(node, "predicted-by") || numbers.has(node, "horizon"))) {
      reader.error(node, w("life-cycle"),
                   "a model of prediction for a measurement that is " + text(*kind),
                   "the life-cycle prediction");
      return std::nullopt;
    }
    if (reader.text(*kind) == "static") return Static{};
    if (reader.text(*kind) == "time-dependent") {
      return TimeDependent{.validity = *validity,
                           .expiry = numbers.has(node, "expiry") ? *expiry : Stamp::max()};
    }
    if (reader.text(*kind) == "prediction") {
      auto model = prediction(node, measured);
      if (!model) return std::nullopt;
      return Prediction{.model = std::move(*model), .horizon = *horizon};
    }
    reader.error(node, w("life-cycle"), "there is no life-cycle '" + text(*kind) + "' in models",
                 "static, time-dependent or prediction");
    return std::nullopt;
  }

  std::optional<Interpolation> interpolation(Id node) {
    if (!numbers.has(node, "interpolation")) return Interpolation::kLinear;
    const auto name = reader.one(node, w("interpolation"), "the interpolation");
    if (!name) return std::nullopt;
    if (reader.text(*name) == "linear") return Interpolation::kLinear;
    if (reader.text(*name) == "screw") return Interpolation::kScrew;
    if (reader.text(*name) == "hold") return Interpolation::kHold;
    reader.error(node, w("interpolation"), "there is no interpolation '" + text(*name) + "'",
                 "linear, screw or hold");
    return std::nullopt;
  }

  // The deviation by which Choice::kMostCertain and Way::kMostCertain compare, in metres.
  std::optional<double> deviation(Id node) {
    if (!numbers.has(node, "deviation")) return MeasurementModel{}.standard_deviation;
    const auto value = reader.one(node, w("deviation"), "the standard deviation");
    if (!value) return std::nullopt;
    const auto number = reader.number(*value, w("number"));
    const auto scale = reader.scale(*value, model::dimension::kLength, "the standard deviation");
    if (!number || !scale) return std::nullopt;
    if (*number < 0) {
      reader.error(*value, w("number"), fmt::format("a deviation of {}", *number),
                   "none is below zero");
      return std::nullopt;
    }
    return *scale * *number;
  }

  std::optional<std::uint32_t> entries(Id node, bool is_static) {
    if (!numbers.has(node, "entries")) return is_static ? 1 : kUsualCapacity;
    const auto literal = reader.one(node, w("entries"), "the number of entries that are kept");
    if (!literal) return std::nullopt;
    const auto count = reader.view.terms().integer_value(*literal);
    if (count && *count >= 1 && *count <= std::int64_t{kMaximumCapacity}) {
      return static_cast<std::uint32_t>(*count);
    }
    reader.error(node, w("entries"), text(*literal) + " entries are kept",
                 "an integer from 1 to " + std::to_string(kMaximumCapacity));
    return std::nullopt;
  }

  std::optional<MeasurementModel> model_of(Id node, const Measured& measured) {
    const auto cycle = life_cycle(node, measured);
    const auto period = numbers.duration(node, "period");
    const auto provenance = reader.one(node, w("provenance"), "who provides the measurement");
    const auto between = interpolation(node);
    const auto standard_deviation = deviation(node);
    if (!cycle || !period || !provenance || !between || !standard_deviation) return std::nullopt;
    MeasurementModel model{.life_cycle = *cycle,
                           .interpolation = *between,
                           .provenance = text(*provenance),
                           .standard_deviation = *standard_deviation,
                           .period = *period};
    for (const Id user : reader.objects(node, w("used-by"))) model.used_by.push_back(text(user));
    if (const Id seen_from = reader.view.object(node, w("coord-frame"))) {
      model.coord_frame = text(seen_from);
    }
    return model;
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
    auto found = si_numbers(stated, "numbers", measured.size);
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

  // What is measured, of a relation of that kind; reports what is no quantity.
  std::optional<Measured> measured_of(Id node, FrameId of, FrameId with_respect_to) {
    Measured measured{.of = of, .with_respect_to = with_respect_to};
    if (!numbers.has(node, "quantity")) return measured;
    const auto name = reader.one(node, w("quantity"), "the quantity");
    if (!name) return std::nullopt;
    for (const Quantity each :
         {Quantity::kPose, Quantity::kTwist, Quantity::kAcceleration, Quantity::kJointPosition,
          Quantity::kJointVelocity, Quantity::kJointAcceleration, Quantity::kOther}) {
      if (reader.text(*name) != to_string(each)) continue;
      measured.quantity = each;
      measured.size = size_of(each);
      if (each != Quantity::kOther) return measured;
      const auto stated = reader.one(node, w("size"), "how many numbers it has");
      if (!stated) return std::nullopt;
      const auto size = reader.view.terms().integer_value(*stated);
      if (size && *size >= 1 && *size <= std::int64_t{kMaximumValues}) {
        measured.size = static_cast<std::uint32_t>(*size);
        return measured;
      }
      reader.error(node, w("size"), text(*stated) + " numbers",
                   "an integer from 1 to " + std::to_string(kMaximumValues));
      return std::nullopt;
    }
    reader.error(node, w("quantity"), "there is no quantity '" + text(*name) + "'",
                 "pose, twist, acceleration, joint-position, joint-velocity, joint-acceleration or "
                 "other");
    return std::nullopt;
  }

  void measurement(Id node, RelationId relation, FrameId of, FrameId with_respect_to) {
    const auto measured = measured_of(node, of, with_respect_to);
    if (!measured) return;
    auto model = model_of(node, *measured);
    if (!model) return;
    const bool is_static = std::holds_alternative<Static>(model->life_cycle);
    const auto capacity = entries(node, is_static);
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
