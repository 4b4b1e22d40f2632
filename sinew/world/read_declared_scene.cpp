// Reading what declared_scene.h describes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/vocab/vocab.h"
#include "sinew/world/declared_scene.h"
#include "sinew/world/scene_conditions.h"
#include "sinew/world/scene_numbers.h"
#include "sinew/world/state.h"

namespace sinew::world {
namespace {

using graph::Id;

constexpr std::string_view kLabel = "http://www.w3.org/2000/01/rdf-schema#label";

struct Reading {
  const World& world;
  State state;
  SceneNumbers numbers;
  model::GraphReader& reader;
  const MeshFiles& meshes;
  DeclaredScene scene;

  Id w(std::string_view term) { return numbers.w(term); }
  std::string named(Id node) {
    return reader.view.terms().is_blank(node) ? std::string() : numbers.text(node);
  }

  // ---- shapes ----

  std::optional<double> length(Id node, std::string_view property, double scale) {
    const auto value = reader.number(node, numbers.store.terms().iri(property));
    if (!value) return std::nullopt;
    return scale * *value;
  }

  std::optional<Geometry> geometry(Id node) {
    struct Kind {
      std::string_view type;
      std::optional<Geometry> (Reading::*read)(Id, double);
    };
    static constexpr Kind kKinds[] = {
        {vocab::shape::Box, &Reading::box},
        {vocab::shape::Sphere, &Reading::sphere},
        {vocab::shape::Cylinder, &Reading::cylinder},
        {vocab::w::Polygon, &Reading::polygon},
        {vocab::w::MeshBounds, &Reading::mesh_bounds},
        {vocab::shape::Mesh, &Reading::mesh},
    };
    const Kind* kind = nullptr;
    int kinds = 0;
    for (const Kind& row : kKinds) {
      if (!reader.is_a(node, numbers.store.terms().iri(row.type))) continue;
      kind = &row;
      ++kinds;
    }
    if (kinds != 1) {
      reader.error(node, reader.ids.type,
                   kinds > 1 ? "a shape of several kinds" : "a shape of no known kind",
                   "one of Box, Sphere, Cylinder, Polygon, MeshBounds, Mesh");
      return std::nullopt;
    }
    const auto scale = reader.scale(node, model::dimension::kLength, "the shape");
    if (!scale) return std::nullopt;
    std::optional<Geometry> result = (this->*kind->read)(node, *scale);
    if (!result) return std::nullopt;
    try {
      check_shape(*result, numbers.text(node));
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) {
        reader.error(node, {}, problem.what, problem.remedy);
      }
      return std::nullopt;
    }
    return result;
  }
  std::optional<Geometry> box(Id node, double scale) {
    const auto size = numbers.vector(node, numbers.store.terms().iri(vocab::shape::size));
    if (!size) return std::nullopt;
    return Box{scale * *size};
  }
  std::optional<Geometry> sphere(Id node, double scale) {
    const auto radius = length(node, vocab::shape::radius, scale);
    if (!radius) return std::nullopt;
    return Sphere{*radius};
  }
  std::optional<Geometry> cylinder(Id node, double scale) {
    const auto radius = length(node, vocab::shape::radius, scale);
    const auto height = length(node, vocab::shape::length, scale);
    if (!radius || !height) return std::nullopt;
    return Cylinder{*radius, *height};
  }
  std::optional<Geometry> polygon(Id node, double scale) {
    auto outline = numbers.corners(node, w("outline"), kMaximumPolygonCorners);
    const auto bottom = length(node, vocab::w::bottom, scale);
    const auto top = length(node, vocab::w::top, scale);
    if (!outline || !bottom || !top) return std::nullopt;
    for (auto& [x, y] : *outline) x *= scale, y *= scale;
    return Polygon{std::move(*outline), *bottom, *top};
  }
  std::optional<Geometry> mesh_bounds(Id node, double scale) {
    const auto lowest = numbers.vector(node, w("lowest"));
    const auto highest = numbers.vector(node, w("highest"));
    if (!lowest || !highest) return std::nullopt;
    return MeshBounds{scale * *lowest, scale * *highest};
  }

  std::optional<Vector3> mesh_scale(Id node) {
    const Id property = numbers.store.terms().iri(vocab::shape::scale);
    return reader.has(node, property) ? numbers.vector(node, property)
                                      : std::optional(Vector3{1, 1, 1});
  }
  std::optional<Geometry> mesh(Id node, double unit) {
    const auto file =
        reader.one(node, numbers.store.terms().iri(vocab::shape::file), "the mesh's file");
    const auto scale = mesh_scale(node);
    if (!file || !scale) return std::nullopt;
    try {
      return load_mesh(resolve_mesh(numbers.text(*file), meshes), unit * *scale);
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) {
        reader.error(node, numbers.store.terms().iri(vocab::shape::file),
                     problem.iri + ": " + problem.what, problem.remedy);
      }
      return std::nullopt;
    }
  }

  std::optional<DeclaredShape> shape(Id node) {
    const auto seen_by =
        reader.one(node, reader.ids.seen_by, "the frame that the shape is seen by");
    auto geometry = this->geometry(node);
    const auto placement = numbers.pose(node, false);
    if (!seen_by || !geometry || !placement) return std::nullopt;
    const FrameId frame = world.find_frame(reader.text(*seen_by));
    if (!frame) {
      reader.error(node, reader.ids.seen_by, numbers.text(*seen_by) + " is no frame of this world",
                   "a Frame of the scene or of its robots");
      return std::nullopt;
    }
    DeclaredShape result{named(node), frame, {std::move(*geometry), *placement}};
    if (const Id file = reader.view.object(node, numbers.store.terms().iri(vocab::shape::file))) {
      result.mesh_file = numbers.text(file);
      const auto scale = reader.scale(node, model::dimension::kLength, "the shape");
      result.mesh_scale = scale.value_or(1) * mesh_scale(node).value_or(Vector3{1, 1, 1});
    }
    return result;
  }

  void body(Id node, DeclaredKind kind) {
    const std::vector<Id> shapes = reader.objects(node, w("shaped-as"));
    const std::vector<Id> declared = reader.objects(node, w("declares"));
    if (kind == DeclaredKind::kArea && shapes.empty()) {
      reader.error(node, w("shaped-as"), "an area without a shape", "what lies within: a shape");
    }
    if (shapes.empty()) {
      if (!declared.empty()) {
        reader.error(node, w("declares"), "declares a number, and has no shape",
                     "relations are between bodies: shaped-as, with a shape");
      }
      return;
    }
    DeclaredBody body{
        .iri = numbers.text(node), .kind = kind, .frame = {}, .shapes = {}, .numbers = {}};
    if (kind == DeclaredKind::kFrame) {
      body.frame = world.find_frame(body.iri);
    } else {
      const auto to = reader.one(node, w("attached-to"), "the frame that it is attached to");
      if (!to) return;
      // An object's frame is the world's, which may have changed since the scene was written.
      const ObjectId object = world.find_object(body.iri);
      body.frame = object ? world.frame_of(object) : world.find_frame(reader.text(*to));
      if (kind == DeclaredKind::kObject && !object) return;  // load_scene has said why
    }
    if (!body.frame) {
      reader.error(node, w("attached-to"), "is attached to what is no frame of this world",
                   "a Frame of the scene or of its robots");
      return;
    }
    for (const Id id : shapes) {
      auto read = shape(id);
      if (read) body.shapes.push_back(std::move(*read));
    }
    for (const Id id : declared) number(id, body);
    scene.bodies.push_back(std::move(body));
  }

  // The unit of a declared number is that of the quantity whose bound it is.
  void number(Id node, DeclaredBody& body) {
    const auto property = reader.one(node, w("property"), "the property that is declared");
    const auto value = reader.number(node, w("number"));
    if (!property || !value) return;
    for (const Rule& rule : rules_of(scene)) {
      for (const Condition& condition : rule.conditions) {
        if (condition.maximum_of != reader.text(*property)) continue;
        const std::string unit(find_quantity(condition.quantity)->unit);
        const auto scale = reader.scale(node, dimension_of(unit), "the declared number");
        if (scale) body.numbers.push_back({numbers.text(*property), unit, *scale * *value});
        return;
      }
    }
    reader.error(node, w("property"), "no rule asks for '" + numbers.text(*property) + "'",
                 "'reach', or a property that a rule's condition names as its maximum-of");
  }

  // ---- rules ----

  void rule(Id node) {
    const auto called = reader.one(node, w("called"), "what the relation is called");
    const auto axes = reader.one(node, w("axes"), "the axes along which is measured");
    const auto bodies = reader.one(node, w("bodies"), "the number of bodies");
    if (!called || !axes || !bodies) return;
    Rule rule{.name = numbers.text(*called), .conditions = {}};
    bool known = false;
    for (const Axes each : {Axes::kSpace, Axes::kSecond, Axes::kViewer}) {
      if (reader.text(*axes) == to_string(each)) rule.axes = each, known = true;
    }
    if (!known) {
      reader.error(node, w("axes"), "there are no axes '" + numbers.text(*axes) + "'",
                   "space, second or viewer");
      return;
    }
    const auto count = reader.view.terms().integer_value(*bodies);
    if (count != 2 && count != 3) {
      reader.error(node, w("bodies"), "a relation of " + numbers.text(*bodies) + " bodies",
                   "2 or 3");
      return;
    }
    rule.ternary = count == 3;
    for (const Id id : reader.objects(node, w("condition"))) {
      auto condition = read_condition(numbers, id);
      if (condition) rule.conditions.push_back(std::move(*condition));
    }
    scene.rules.push_back({named(node), std::move(rule)});
  }

  // What Relations will refuse, while there is a place to name.
  void check_rules(const std::vector<Id>& nodes) {
    for (std::size_t i = 0; i < scene.rules.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (scene.rules[i].rule.name == scene.rules[j].rule.name) {
          reader.error(nodes[i], w("called"),
                       "'" + scene.rules[i].rule.name + "' has two rules in these models",
                       "one rule for each relation");
        }
      }
      try {
        check_rule(scene.rules[i].rule);
      } catch (const Error& error) {
        for (const Problem& problem : error.problems()) {
          reader.error(nodes[i], w("condition"), problem.what, problem.remedy);
        }
      }
    }
  }

  // ---- covariances ----

  std::optional<Covariance> pose_covariance(Id node, const RelationRecord& relation) {
    const auto seen_by = reader.one(node, reader.ids.seen_by, "the frame that sees the covariance");
    const auto angle = reader.scale(node, model::dimension::kAngle, "the covariance's angles");
    const auto length = reader.scale(node, model::dimension::kLength, "the covariance's lengths");
    if (!seen_by || !angle || !length) return std::nullopt;
    if (world.find_frame(reader.text(*seen_by)).index != relation.of) {
      reader.error(node, reader.ids.seen_by, "the covariance is seen by " + numbers.text(*seen_by),
                   "seen by the frame whose pose is measured, " + world.name(FrameId{relation.of}));
      return std::nullopt;
    }
    if (!numbers.has(node, "matrix")) {
      const auto of_angles = reader.number(node, w("angular-deviation"));
      const auto of_lengths = reader.number(node, w("linear-deviation"));
      if (!of_angles || !of_lengths) return std::nullopt;
      if (*of_angles < 0 || *of_lengths < 0) {
        reader.error(node, *of_angles < 0 ? w("angular-deviation") : w("linear-deviation"),
                     fmt::format("a deviation of {}", std::min(*of_angles, *of_lengths)),
                     "none is below zero");
        return std::nullopt;
      }
      return isotropic(*angle * *of_angles, *length * *of_lengths);
    }
    const auto entries = numbers.list(node, w("matrix"), 36);
    if (!entries) return std::nullopt;
    Covariance S;
    double largest = 0;
    for (std::size_t row = 0; row < 6; ++row) {
      for (std::size_t column = 0; column < 6; ++column) {
        S(row, column) = (row < 3 ? *angle : *length) * (column < 3 ? *angle : *length) *
                         (*entries)[6 * row + column];
        largest = std::max(largest, std::abs(S(row, column)));
      }
    }
    for (std::size_t row = 0; row < 6; ++row) {
      for (std::size_t column = 0; column < row; ++column) {
        if (std::abs(S(row, column) - S(column, row)) <= kSymmetryTolerance * largest) continue;
        reader.error(node, w("matrix"),
                     fmt::format("the covariance is not symmetric: entry ({}, {}) is {}, and "
                                 "({}, {}) is {}",
                                 row + 1, column + 1, (*entries)[6 * row + column], column + 1,
                                 row + 1, (*entries)[6 * column + row]),
                     "the same number on both sides of the diagonal");
        return std::nullopt;
      }
    }
    if (!is_covariance(S)) {
      reader.error(node, w("matrix"),
                   "the covariance is not positive: along some axis the variance is negative",
                   "a positive semidefinite matrix; correlations are at most 1");
      return std::nullopt;
    }
    return S;
  }

  void covariance(Id measured, Id node) {
    const MeasurementId measurement = world.find_measurement(reader.text(measured));
    if (!measurement) {
      reader.error(
          measured, w("covariance"), "has a covariance, and is no measurement of this world",
          "a Measurement of the scene, or JOINT/position of a robot that was added before");
      return;
    }
    const MeasurementRecord& record = state.measurements[measurement.index];
    const RelationRecord& relation = state.relations[record.relation];
    const bool of_pose = record.quantity == Quantity::kPose;
    if (!of_pose && record.quantity != Quantity::kJointPosition) {
      reader.error(measured, w("covariance"),
                   "a covariance of a " + std::string(to_string(record.quantity)),
                   "poses and joint positions have one");
    } else if (node == w("Exact")) {
      scene.covariances.push_back({measurement, Exactly{}});
    } else if (of_pose && reader.is_a(node, w("PoseCovariance"))) {
      const auto S = pose_covariance(node, relation);
      if (S) scene.covariances.push_back({measurement, *S});
    } else if (!of_pose && reader.is_a(node, w("JointCovariance"))) {
      const bool turns = relation.kind == RelationKind::kRevolute;
      const auto number = reader.number(node, w("number"));
      const auto scale =
          reader.scale(node, turns ? model::dimension::kAngle : model::dimension::kLength,
                       "the joint's deviation");
      if (!number || !scale) return;
      if (*number < 0) {
        reader.error(node, w("number"), fmt::format("a deviation of {}", *number),
                     "none is below zero");
        return;
      }
      scene.covariances.push_back({measurement, *scale * *number});
    } else {
      reader.error(measured, w("covariance"), numbers.text(node) + " does not fit what is measured",
                   of_pose ? "a PoseCovariance, or w:Exact" : "a JointCovariance, or w:Exact");
    }
  }

  void run() {
    std::vector<Id> rules;
    for (const Id node : reader.all(w("RelationRule"))) {
      const std::size_t before = scene.rules.size();
      rule(node);
      if (scene.rules.size() > before) rules.push_back(node);
    }
    check_rules(rules);
    for (const Id node : reader.all(w("Object"))) body(node, DeclaredKind::kObject);
    for (const Id node : reader.all(reader.ids.frame)) body(node, DeclaredKind::kFrame);
    for (const Id node : reader.all(w("Area"))) body(node, DeclaredKind::kArea);
    std::vector<std::pair<Id, Id>> covariances, labels;
    const auto collect = [&](Id property, std::vector<std::pair<Id, Id>>& into) {
      reader.view.match({}, property, {}, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
        into.emplace_back(quad.subject, quad.object);
        return true;
      });
    };
    collect(w("covariance"), covariances);
    for (const auto& [measured, node] : covariances) covariance(measured, node);
    collect(numbers.store.terms().iri(kLabel), labels);
    for (const auto& [node, label] : labels) {
      const bool ours = reader.is_a(node, w("Object")) || reader.is_a(node, w("Area")) ||
                        reader.is_a(node, reader.ids.frame);
      if (ours) scene.labels.emplace(numbers.text(node), numbers.text(label));
    }
  }
};

}  // namespace

DeclaredScene read_scene(const World& world, graph::Store& store, const graph::Places& places,
                         Report& report, const MeshFiles& meshes) {
  model::GraphReader reader(store, places, report);
  Reading reading{.world = world,
                  .state = world.state(),
                  .numbers = {reader, store},
                  .reader = reader,
                  .meshes = meshes,
                  .scene = {}};
  reading.run();
  return std::move(reading.scene);
}

}  // namespace sinew::world
