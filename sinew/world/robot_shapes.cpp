#include "sinew/world/robot_shapes.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "sinew/vocab/vocab.h"
#include "sinew/world/scene_numbers.h"

namespace sinew::world {
namespace {

using graph::Id;

struct RobotShapes {
  const World& world;
  graph::Store& store;
  model::GraphReader& reader;
  SceneNumbers numbers;
  const MeshFiles& meshes;
  std::vector<DeclaredBody> bodies;

  Id iri(std::string_view text) { return store.terms().iri(text); }

  // Direction cosines, and x, y, z.
  std::optional<Pose> placement(Id node, double scale) {
    const auto x = numbers.vector(node, iri(vocab::geom_coord::direction_cosine_x));
    const auto y = numbers.vector(node, iri(vocab::geom_coord::direction_cosine_y));
    const auto z = numbers.vector(node, iri(vocab::geom_coord::direction_cosine_z));
    const auto px = reader.number(node, iri(vocab::geom_coord::x));
    const auto py = reader.number(node, iri(vocab::geom_coord::y));
    const auto pz = reader.number(node, iri(vocab::geom_coord::z));
    if (!x || !y || !z || !px || !py || !pz) return std::nullopt;
    math::Pose<double> X;
    X.R = {x->x, y->x, z->x, x->y, y->y, z->y, x->z, y->z, z->z};
    X.p = {scale * *px, scale * *py, scale * *pz};
    return from_matrix(X);
  }

  std::optional<double> length(Id node, std::string_view property, double scale) {
    const auto value = reader.number(node, iri(property));
    return value ? std::optional(scale * *value) : std::nullopt;
  }

  std::optional<Geometry> geometry(Id node, double scale, DeclaredShape& declared) {
    if (reader.is_a(node, iri(vocab::shape::Box))) {
      const auto size = numbers.vector(node, iri(vocab::shape::size));
      return size ? std::optional<Geometry>(Box{scale * *size}) : std::nullopt;
    }
    if (reader.is_a(node, iri(vocab::shape::Sphere))) {
      const auto radius = length(node, vocab::shape::radius, scale);
      return radius ? std::optional<Geometry>(Sphere{*radius}) : std::nullopt;
    }
    if (reader.is_a(node, iri(vocab::shape::Cylinder))) {
      const auto radius = length(node, vocab::shape::radius, scale);
      const auto height = length(node, vocab::shape::length, scale);
      if (!radius || !height) return std::nullopt;
      return Cylinder{*radius, *height};
    }
    const auto file = reader.one(node, iri(vocab::shape::file), "the mesh's file");
    const auto factor = numbers.vector(node, iri(vocab::shape::scale));
    if (!file || !factor) return std::nullopt;
    declared.mesh_file = numbers.text(*file);
    declared.mesh_scale = scale * *factor;
    return load_mesh(resolve_mesh(declared.mesh_file, meshes), declared.mesh_scale);
  }

  void collision(Id node) {
    const auto seen_by =
        reader.one(node, reader.ids.seen_by, "the frame that the shape is seen by");
    const auto scale = reader.scale(node, model::dimension::kLength, "the shape");
    if (!seen_by || !scale) return;
    const std::string name = numbers.text(*seen_by);
    const FrameId frame = world.find_frame(name);
    if (!frame) {
      reader.warning(node, reader.ids.seen_by, name + " is no frame of this world",
                     "the robot's frames, loaded before; the shape is left out");
      return;
    }
    DeclaredShape declared{numbers.text(node), frame, {}};
    try {
      auto found = geometry(node, *scale, declared);
      const auto where = placement(node, *scale);
      if (!found || !where) return;
      check_shape(*found, declared.iri);
      declared.shape = {std::move(*found), *where};
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) {
        reader.warning(node, {}, problem.iri + ": " + problem.what + "; the shape is left out",
                       problem.remedy);
      }
      return;
    }
    const auto there = std::find_if(bodies.begin(), bodies.end(),
                                    [&](const DeclaredBody& body) { return body.frame == frame; });
    DeclaredBody& body = there != bodies.end()
                             ? *there
                             : bodies.emplace_back(DeclaredBody{.iri = name,
                                                                .kind = DeclaredKind::kFrame,
                                                                .frame = frame,
                                                                .shapes = {},
                                                                .numbers = {}});
    body.shapes.push_back(std::move(declared));
  }
};

}  // namespace

std::vector<DeclaredBody> read_robot_shapes(const World& world, graph::Store& store,
                                            const graph::Places& places, Report& report,
                                            const MeshFiles& meshes) {
  model::GraphReader reader(store, places, report);
  RobotShapes shapes{world, store, reader, {reader, store}, meshes, {}};
  for (const Id node : reader.all(shapes.iri(vocab::shape::Collision))) shapes.collision(node);
  return std::move(shapes.bodies);
}

}  // namespace sinew::world
