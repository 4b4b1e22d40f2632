// What a scene's models say beyond its structure (scene.h): shapes of objects, frames and named
// areas, covariances of measurements, and rules for qualitative relations. With `w:` =
// https://w3id.org/sinew/world# and `shape:` = https://w3id.org/sinew/shape#
//
//   O | F w:shaped-as S          the shape of an object or a frame; several are its union
//   A a w:Area ; w:attached-to F ; w:shaped-as S ; rdfs:label "storage magazine"
//   S a shape:Box ; shape:size (x y z) | shape:Sphere ; shape:radius r
//     | shape:Cylinder ; shape:radius r ; shape:length l
//     | w:Polygon ; w:outline ((x y) …) ; w:bottom z ; w:top z
//     | w:MeshBounds ; w:lowest (x y z) ; w:highest (x y z)
//     | shape:Mesh ; shape:file "package://cell/bolt.stl" ; shape:scale (x y z) ;
//     geom-coord:as-seen-by F ; qudt:unit U ; w:position (x y z) ; w:quaternion (x y z w)
//   M w:covariance C             C is w:Exact, or
//   C a w:PoseCovariance ; geom-coord:as-seen-by F ; w:angular-deviation a ; w:linear-deviation b
//     or w:matrix (36 numbers by rows, angular first) ; qudt:unit U_angle, U_length
//   C a w:JointCovariance ; w:number d ; qudt:unit U
//   R a w:RelationRule ; w:called "on" ; w:axes "space" ; w:bodies 2 ; w:condition K
//   K w:measures "height-gap" ; w:minimum n ; w:maximum n ; w:maximum-of "reach" ; qudt:unit U
//   O w:declares N ;  N w:property "reach" ; w:number n ; qudt:unit U
//
// A mesh is its triangles, and where they are closed the solid within (mesh_file.h); the unit is
// that of the file's numbers after scaling, and the scale is 1 where there is none.
//
// The shape's own axes are those of the frame that sees it, moved by its position and quaternion
// where they are stated. That frame is the body's own, or one whose pose in it is constant.
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/world/mesh_file.h"
#include "sinew/world/qualitative.h"
#include "sinew/world/space.h"
#include "sinew/world/uncertain_path.h"
#include "sinew/world/world.h"

namespace sinew::world {

struct DeclaredShape {
  std::string iri;  // empty: a blank node
  FrameId seen_by;
  Shape shape;  // placed in that frame
  // Of a mesh: its file as the model names it, and its scale.
  std::string mesh_file = {};
  Vector3 mesh_scale = {1, 1, 1};
};

struct DeclaredNumber {
  std::string property, unit;  // "m", "rad" or "1", as of the rule that asks for it
  double value = 0;            // in that unit
};

enum class DeclaredKind : std::uint8_t { kObject, kFrame, kArea };

struct DeclaredBody {
  std::string iri;
  DeclaredKind kind = DeclaredKind::kObject;
  FrameId frame;  // that it is attached to
  std::vector<DeclaredShape> shapes;
  std::vector<DeclaredNumber> numbers;
};

struct Exactly {};
struct DeclaredCovariance {
  MeasurementId measurement;
  std::variant<Exactly, double, Covariance> value;  // a joint's deviation, or a pose's
};

struct DeclaredRule {
  std::string iri;  // empty: a blank node
  Rule rule;
};

struct DeclaredScene {
  std::vector<DeclaredBody> bodies;
  std::vector<DeclaredCovariance> covariances;
  std::vector<DeclaredRule> rules;
  std::map<std::string, std::string> labels;  // of bodies, objects and areas, by IRI

  // The IRI of what is called so: an IRI itself, or a label that one thing has. Empty: none.
  std::string find(std::string_view iri_or_label) const;
};

// For a world that load_scene (and add_robot) has filled. What is wrong is in the report, with its
// place, and left out of the result.
DeclaredScene read_scene(const World& world, graph::Store& store, const graph::Places& places,
                         Report& report, const MeshFiles& meshes = {});

// ---- from what is declared to what answers ----

// Throws Error where the frame that sees a shape is not fixed to the body's.
void add_bodies(Space& space, const DeclaredScene& scene);
Uncertainties uncertainties_of(const World& world, const DeclaredScene& scene);
// usual_rules(), with those that the scene declares in place of or beside them.
std::vector<Rule> rules_of(const DeclaredScene& scene);
// With the declared rules and numbers; the space has the scene's bodies and must outlive it.
Relations relations_of(const Space& space, const DeclaredScene& scene);

}  // namespace sinew::world
