// A world and what its scene declares, as a model: the way back of scene.cpp and
// read_declared_scene.cpp.
#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "sinew/graph/standard_iris.h"
#include "sinew/vocab/vocab.h"
#include "sinew/world/block_set.h"
#include "sinew/world/impl.h"
#include "sinew/world/scene.h"
#include "sinew/world/state.h"
#include "sinew/world/symbols.h"
#include "sinew/world/triangle_mesh.h"

namespace sinew::world {
namespace {

using graph::Id;

struct SceneWriter {
  const World& world;
  const DeclaredScene& scene;
  graph::Store& store;
  Report& report;
  const SceneWriting& options;
  State state = world.state();
  graph::Transaction transaction = store.begin();

  graph::Terms& terms() { return store.terms(); }
  Id iri(std::string_view text) { return terms().iri(text); }
  Id w(std::string_view term) { return iri(std::string(kWorldNamespace) + std::string(term)); }
  Id unit(std::string_view name) { return iri("http://qudt.org/vocab/unit/" + std::string(name)); }
  Id node(const std::string& name) { return name.empty() ? terms().fresh_blank() : iri(name); }
  void add(Id subject, Id predicate, Id object) {
    transaction.add({subject, predicate, object, {}});
  }
  void add(Id subject, std::string_view predicate, Id object) {
    add(subject, iri(predicate), object);
  }
  void type(Id subject, std::string_view type) { add(subject, graph::kRdfType, iri(type)); }
  void units(Id subject, std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) add(subject, vocab::qudt::unit, unit(name));
  }

  Id list(const std::vector<Id>& values) {
    Id rest = iri(graph::kRdfNil);
    for (auto value = values.rbegin(); value != values.rend(); ++value) {
      const Id cell = terms().fresh_blank();
      add(cell, graph::kRdfFirst, *value);
      add(cell, graph::kRdfRest, rest);
      rest = cell;
    }
    return rest;
  }
  Id numbers(std::span<const double> values) {
    std::vector<Id> literals;
    for (const double value : values) literals.push_back(terms().real(value));
    return list(literals);
  }
  Id numbers(std::initializer_list<double> values) {
    return numbers(std::span<const double>(values.begin(), values.size()));
  }
  Id vector(const Vector3& v) { return numbers({v.x, v.y, v.z}); }
  Id quaternion(const Quaternion& q) { return numbers({q.x, q.y, q.z, q.w}); }
  // Numbers in the order of a quantity.
  void si_numbers(Id subject, std::string_view term, std::span<const double> values) {
    add(subject, w(term), numbers(values));
    add(subject, w("system"), terms().literal("SI"));
  }
  Id stamp(Stamp at) { return quantity(terms().integer(ns_of(at)), "NanoSEC"); }

  // A node with a number and its unit. Durations are whole nanoseconds, and written as such.
  Id quantity(Id number, std::string_view unit_name) {
    const Id result = terms().fresh_blank();
    add(result, w("number"), number);
    units(result, {unit_name});
    return result;
  }
  void duration(Id subject, std::string_view term, Duration value) {
    if (value == kForever) return;
    const double seconds = seconds_of(value);
    const bool exact = duration_of_seconds(seconds) == value;
    add(subject, w(term),
        exact ? quantity(terms().real(seconds), "SEC")
              : quantity(terms().integer(value.count()), "NanoSEC"));
  }

  void left_out(const std::string& name, std::string what) {
    report.warning({}, name, std::move(what) + ", and is left out",
                   "keep what is needed of it beside the scene");
  }

  // ---- the structure ----

  Id pose_value(const Pose& pose, Index seen_by) {
    const Id value = terms().fresh_blank();
    type(value, vocab::w::PoseValue);
    add(value, vocab::geom_coord::as_seen_by, iri(world.name(FrameId{seen_by})));
    add(value, w("position"), vector(pose.p));
    add(value, w("quaternion"), quaternion(pose.q));
    units(value, {"UNITLESS", "M"});
    return value;
  }

  void prediction(Id subject, const Prediction& prediction, Index with_respect_to, bool is_pose,
                  const std::string& name) {
    const Id model = terms().fresh_blank();
    if (const auto* constant = std::get_if<ConstantVelocity>(&prediction.model)) {
      type(model, vocab::w::ConstantVelocity);
      if (constant->twist) {
        add(model, w("angular"), vector(constant->twist->angular));
        add(model, w("linear"), vector(constant->twist->linear));
        units(model, {"RAD-PER-SEC", "M-PER-SEC"});
      }
      if (!constant->rates.empty()) si_numbers(model, "rates", constant->rates);
    } else if (const auto* faster = std::get_if<ConstantAcceleration>(&prediction.model)) {
      type(model, std::string(kWorldNamespace) + "ConstantAcceleration");
      if (is_pose) {
        add(model, w("angular"), vector(faster->twist.angular));
        add(model, w("linear"), vector(faster->twist.linear));
        add(model, w("angular-rate"), vector(faster->twist_rate.angular));
        add(model, w("linear-rate"), vector(faster->twist_rate.linear));
        units(model, {"RAD-PER-SEC", "M-PER-SEC", "RAD-PER-SEC2", "M-PER-SEC2"});
      } else {
        si_numbers(model, "rates", faster->rates);
        si_numbers(model, "accelerations", faster->accelerations);
      }
    } else if (const auto* conveyor = std::get_if<Conveyor>(&prediction.model)) {
      type(model, vocab::w::Conveyor);
      add(model, w("linear"), vector(conveyor->velocity_A));
      add(model, vocab::geom_coord::as_seen_by, iri(world.name(FrameId{with_respect_to})));
      units(model, {"M-PER-SEC"});
    } else {
      left_out(name, "is predicted by a model that is in code");
      add(subject, w("life-cycle"), terms().literal("time-dependent"));
      return;
    }
    add(subject, w("life-cycle"), terms().literal("prediction"));
    add(subject, w("predicted-by"), model);
    duration(subject, "horizon", prediction.horizon);
  }

  void life_cycle(Id node, const MeasurementRecord& record, const RelationRecord& relation,
                  const std::string& name) {
    const LifeCycle& life_cycle = record.model->life_cycle;
    if (const auto* timed = std::get_if<TimeDependent>(&life_cycle)) {
      add(node, w("life-cycle"), terms().literal("time-dependent"));
      duration(node, "validity", timed->validity);
      if (timed->expiry != Stamp::max()) add(node, w("expiry"), stamp(timed->expiry));
    } else if (const auto* predicted = std::get_if<Prediction>(&life_cycle)) {
      prediction(node, *predicted, relation.with_respect_to, record.quantity == Quantity::kPose,
                 name);
    } else {
      add(node, w("life-cycle"), terms().literal("static"));
    }
  }

  void blocks(Id node, const BlockSet& set, const std::string& name) {
    if (set.spec.library_text.empty()) {
      left_out(name, "has data blocks of a library whose text is not known");
      return;
    }
    std::vector<Id> all;
    for (const BlockSpec& spec : set.spec.blocks) {
      const Id block = iri(spec.name);
      all.push_back(block);
      type(block, std::string(kWorldNamespace) + "DataBlock");
      add(block, w("prototype"), terms().literal(spec.prototype));
      add(block, w("consistency"), iri(name + "/data"));
      if (spec.realtime) add(block, w("realtime"), terms().boolean(true));
      if (spec.allow_lossy) add(block, w("allows-lossy"), terms().boolean(true));
    }
    add(node, w("blocks"), list(all));
    add(node, w("library"), terms().literal(set.spec.library_text));
    if (!set.spec.canonical.empty()) {
      add(node, w("canonical"), terms().literal(set.spec.canonical));
    }
  }

  // The last entry; of a prediction the one that it starts from, not what it would be at another
  // time.
  void last_value(Id node, MeasurementId id, const MeasurementRecord& record,
                  const RelationRecord& relation) {
    World::Sample last = world.latest(id, Stamp());
    if (last.status != Status::kNoData) last = world.latest(id, last.bounds.newest);
    if (last.status != Status::kOk) return;
    Id value;
    if (record.quantity == Quantity::kPose) {
      Pose pose;
      pose.q = {last.values[0], last.values[1], last.values[2], last.values[3]};
      pose.p = {last.values[4], last.values[5], last.values[6]};
      value = pose_value(pose, relation.with_respect_to);
    } else {
      value = terms().fresh_blank();
      type(value, std::string(kWorldNamespace) + "Numbers");
      si_numbers(value, "numbers", last.values);
      if (record.quantity == Quantity::kTwist || record.quantity == Quantity::kAcceleration) {
        add(value, vocab::geom_coord::as_seen_by, iri(world.name(FrameId{relation.of})));
      }
    }
    const bool is_static = std::holds_alternative<Static>(record.model->life_cycle);
    if (!is_static && last.stamp != Stamp()) add(value, w("stamp"), stamp(last.stamp));
    add(node, w("value"), value);
  }

  void measurement(Index index, const MeasurementRecord& record, const RelationRecord& relation) {
    const std::string& name = world.name(MeasurementId{index});
    const Id node = iri(name);
    const MeasurementModel& model = *record.model;
    add(iri(world.name(RelationId{record.relation})), w("measured-by"), node);
    type(node, vocab::w::Measurement);
    if (record.quantity != Quantity::kPose) {
      add(node, w("quantity"), terms().literal(to_string(record.quantity)));
    }
    if (record.quantity == Quantity::kOther) {
      add(node, w("size"), terms().integer(record.cell->values()));
    }
    life_cycle(node, record, relation, name);
    add(node, w("provenance"),
        iri(model.provenance.empty() ? kModelProvenance : std::string_view(model.provenance)));
    if (!model.coord_frame.empty()) add(node, w("coord-frame"), iri(model.coord_frame));
    for (const std::string& user : model.used_by) add(node, w("used-by"), iri(user));
    duration(node, "period", model.period);
    if (model.interpolation == Interpolation::kScrew) {
      add(node, w("interpolation"), terms().literal("screw"));
    } else if (model.interpolation == Interpolation::kHold) {
      add(node, w("interpolation"), terms().literal("hold"));
    }
    if (!std::isnan(model.standard_deviation)) {
      add(node, w("deviation"), quantity(terms().real(model.standard_deviation), "M"));
    }
    const bool is_static = std::holds_alternative<Static>(model.life_cycle);
    // A ring has a power of two of slots, one of which is always under the writer's pen.
    const std::uint32_t usual = is_static ? kMinimumCapacity : std::bit_ceil(kUsualCapacity + 1);
    if (record.cell->capacity() != usual) {
      add(node, w("entries"), terms().integer(record.cell->capacity() - 1));
    }
    if (record.history) add(node, w("keeps-all"), terms().boolean(true));
    if (record.blocks) blocks(node, *record.blocks, name);
    if (options.leave_out_values && options.leave_out_values(MeasurementId{index})) {
      left_out(name, "has a value that is not for whoever writes the scene");
      return;
    }
    last_value(node, MeasurementId{index}, record, relation);
  }

  // A frame of which other models say all that there is: it has relations, and each is left out.
  bool is_left_out(Index frame) const {
    if (!options.leave_out || state.frames[frame].first_relation == kNone) return false;
    for (Index at = state.frames[frame].first_relation; at != kNone;) {
      if (!options.leave_out(RelationId{at})) return false;
      const RelationRecord& relation = state.relations[at];
      at = relation.of == frame ? relation.next_at_of : relation.next_at_with_respect_to;
    }
    for (Index i = 0; i < state.objects.size(); ++i) {
      if (state.objects[i].alive && state.objects[i].frame == frame) return false;
    }
    return std::none_of(scene.bodies.begin(), scene.bodies.end(), [&](const DeclaredBody& body) {
      return body.frame.index == frame ||
             std::any_of(body.shapes.begin(), body.shapes.end(),
                         [&](const DeclaredShape& shape) { return shape.seen_by.index == frame; });
    });
  }

  void structure() {
    for (Index i = 0; i < state.frames.size(); ++i) {
      if (state.frames[i].alive && !is_left_out(i)) {
        type(iri(world.name(FrameId{i})), vocab::geom::Frame);
      }
    }
    for (Index i = 0; i < state.objects.size(); ++i) {
      const ObjectRecord& object = state.objects[i];
      if (!object.alive) continue;
      const Id node = iri(world.name(ObjectId{i}));
      type(node, vocab::w::Object);
      add(node, w("attached-to"), iri(world.name(FrameId{object.frame})));
      if (object.model)
        add(node, w("instance-of"), iri(world.impl().family->names.text(object.model)));
    }
    std::vector<bool> written(state.relations.size());
    for (Index i = 0; i < state.relations.size(); ++i) {
      const RelationRecord& relation = state.relations[i];
      if (!relation.alive || (options.leave_out && options.leave_out(RelationId{i}))) continue;
      written[i] = true;
      const Id node = iri(world.name(RelationId{i}));
      add(node, vocab::geom_rel::of, iri(world.name(FrameId{relation.of})));
      if (relation.kind == RelationKind::kProperty) {
        type(node, std::string(kWorldNamespace) + "Property");
        continue;
      }
      type(node, vocab::geom_rel::Pose);
      if (relation.kind != RelationKind::kFree) {
        type(node, std::string(kWorldNamespace) +
                       (relation.kind == RelationKind::kRevolute ? "Revolute" : "Prismatic"));
        add(node, w("placement"), pose_value(relation.placement, relation.with_respect_to));
      }
      add(node, vocab::geom_rel::with_respect_to,
          iri(world.name(FrameId{relation.with_respect_to})));
      if (relation.suspended) add(node, w("suspended"), terms().boolean(true));
      if (relation.attachment) type(node, vocab::w::Attachment);
    }
    for (Index i = 0; i < state.measurements.size(); ++i) {
      const MeasurementRecord& record = state.measurements[i];
      if (record.alive && written[record.relation]) {
        measurement(i, record, state.relations[record.relation]);
      }
    }
  }

  // ---- what is declared ----

  void shape(Id body, const DeclaredShape& declared) {
    const Id node = this->node(declared.iri);
    add(body, w("shaped-as"), node);
    add(node, vocab::geom_coord::as_seen_by, iri(world.name(declared.seen_by)));
    const auto real = [&](std::string_view property, double value) {
      add(node, property, terms().real(value));
    };
    struct Write {
      SceneWriter& writer;
      Id node;
      FrameId seen_by;
      decltype(real)& number;
      void operator()(const Box& box) const {
        writer.type(node, vocab::shape::Box);
        writer.add(node, vocab::shape::size, writer.vector(box.size));
      }
      void operator()(const Sphere& sphere) const {
        writer.type(node, vocab::shape::Sphere);
        number(vocab::shape::radius, sphere.radius);
      }
      void operator()(const Cylinder& cylinder) const {
        writer.type(node, vocab::shape::Cylinder);
        number(vocab::shape::radius, cylinder.radius);
        number(vocab::shape::length, cylinder.height);
      }
      void operator()(const Polygon& polygon) const {
        writer.type(node, vocab::w::Polygon);
        std::vector<Id> corners;
        for (const auto& [x, y] : polygon.outline) corners.push_back(writer.numbers({x, y}));
        writer.add(node, vocab::w::outline, writer.list(corners));
        number(vocab::w::bottom, polygon.bottom);
        number(vocab::w::top, polygon.top);
      }
      void operator()(const Mesh& mesh) const {  // whose file nobody names
        writer.left_out(writer.world.name(seen_by),
                        "is shaped by a mesh of no file: its bounds are written; the mesh itself");
        const Bounds3& box = mesh.triangles->bounds();
        (*this)(MeshBounds{box.minimum, box.maximum});
      }
      void operator()(const MeshBounds& mesh) const {
        writer.type(node, vocab::w::MeshBounds);
        writer.add(node, vocab::w::lowest, writer.vector(mesh.minimum));
        writer.add(node, vocab::w::highest, writer.vector(mesh.maximum));
      }
    };
    if (!declared.mesh_file.empty()) {
      type(node, vocab::shape::Mesh);
      add(node, vocab::shape::file, terms().literal(declared.mesh_file));
      add(node, vocab::shape::scale, vector(declared.mesh_scale));
    } else {
      std::visit(Write{*this, node, declared.seen_by, real}, declared.shape.geometry);
    }
    const auto& [q, p] = declared.shape.placement;
    if (p.x != 0 || p.y != 0 || p.z != 0) add(node, w("position"), vector(p));
    if (q.x != 0 || q.y != 0 || q.z != 0) {
      add(node, w("quaternion"), quaternion(q));
      units(node, {"UNITLESS"});
    }
    units(node, {"M"});
  }

  static std::string_view unit_name(std::string_view unit) {
    return unit == "m" ? "M" : unit == "rad" ? "RAD" : "UNITLESS";
  }

  void bodies() {
    for (const DeclaredBody& body : scene.bodies) {
      const Id node = iri(body.iri);
      if (body.kind == DeclaredKind::kArea) {
        type(node, vocab::w::Area);
        add(node, w("attached-to"), iri(world.name(body.frame)));
      } else if (body.kind == DeclaredKind::kObject && !world.find_object(body.iri)) {
        continue;  // removed since
      }
      for (const DeclaredShape& declared : body.shapes) shape(node, declared);
      for (const DeclaredNumber& number : body.numbers) {
        const Id value = quantity(terms().real(number.value), unit_name(number.unit));
        add(node, w("declares"), value);
        add(value, w("property"), terms().literal(number.property));
      }
    }
    for (const auto& [name, label] : scene.labels) {
      add(iri(name), "http://www.w3.org/2000/01/rdf-schema#label", terms().literal(label));
    }
  }

  void covariances() {
    for (const DeclaredCovariance& declared : scene.covariances) {
      const MeasurementRecord& record = state.measurements[declared.measurement.index];
      if (!record.alive) continue;
      const Id measured = iri(world.name(declared.measurement));
      if (std::holds_alternative<Exactly>(declared.value)) {
        add(measured, w("covariance"), w("Exact"));
        continue;
      }
      const Id node = terms().fresh_blank();
      add(measured, w("covariance"), node);
      const RelationRecord& relation = state.relations[record.relation];
      if (const auto* deviation = std::get_if<double>(&declared.value)) {
        type(node, vocab::w::JointCovariance);
        add(node, w("number"), terms().real(*deviation));
        units(node, {relation.kind == RelationKind::kRevolute ? "RAD" : "M"});
        continue;
      }
      type(node, vocab::w::PoseCovariance);
      add(node, vocab::geom_coord::as_seen_by, iri(world.name(FrameId{relation.of})));
      std::vector<Id> entries;
      for (const double entry : std::get<Covariance>(declared.value).entries) {
        entries.push_back(terms().real(entry));
      }
      add(node, w("matrix"), list(entries));
      units(node, {"RAD", "M"});
    }
  }

  void rules() {
    for (const DeclaredRule& declared : scene.rules) {
      const Id rule = node(declared.iri);
      type(rule, vocab::w::RelationRule);
      add(rule, w("called"), terms().literal(declared.rule.name));
      add(rule, w("axes"), terms().literal(to_string(declared.rule.axes)));
      add(rule, w("bodies"), terms().integer(declared.rule.ternary ? 3 : 2));
      for (const Condition& condition : declared.rule.conditions) {
        const Id part = terms().fresh_blank();
        add(rule, w("condition"), part);
        add(part, w("measures"), terms().literal(condition.quantity));
        if (std::isfinite(condition.minimum)) {
          add(part, w("minimum"), terms().real(condition.minimum));
        }
        if (std::isfinite(condition.maximum)) {
          add(part, w("maximum"), terms().real(condition.maximum));
        }
        if (!condition.maximum_of.empty()) {
          add(part, w("maximum-of"), terms().literal(condition.maximum_of));
        }
        for (const QuantityDescription& row : quantities()) {
          if (row.name == condition.quantity) units(part, {unit_name(row.unit)});
        }
      }
    }
  }
};

}  // namespace

std::vector<std::string> scene_contexts() {
  const std::string published = "https://comp-rob2b.github.io/metamodels/";
  return {published + "geometry/structural-entities.json",
          published + "geometry/spatial-relations.json", published + "geometry/coordinates.json",
          published + "qudt.json", "https://w3id.org/sinew/world.json"};
}

void write_scene(const World& world, const DeclaredScene& scene, graph::Store& store,
                 Report& report, const SceneWriting& options) {
  SceneWriter writer{world, scene, store, report, options};
  writer.structure();
  writer.bodies();
  writer.covariances();
  writer.rules();
  writer.transaction.commit();
}

}  // namespace sinew::world
