// A scene from models in a graph: frames and poses in the published vocabulary of geometry, and
// what Sinew adds, with `w:` = https://w3id.org/sinew/world# (context: world.json there; shapes:
// world.ttl). This is the structure; declared_scene.h has shapes, covariances and rules, and
// declared_rights.h who may do what.
//
//   pose relation        geom-rel:of, geom-rel:with-respect-to; w:measured-by M
//                        or w:value V: static, provided by the model
//   M a w:Measurement ;  w:life-cycle "static" | "time-dependent" | "prediction" ; w:provenance P ;
//                        w:coord-frame F ; w:used-by U ; w:value V ; w:validity T ; w:period T ;
//                        w:interpolation "linear" | "screw" | "hold" ; w:deviation D ;
//                        w:entries 64 ; w:keeps-all true ; w:predicted-by X ; w:horizon T
//   V                    coordinates of the pose (geom-coord:PoseCoordinate), or
//   V a w:PoseValue ;    geom-coord:as-seen-by F ; w:position (x y z) ; w:quaternion (x y z w) ;
//                        qudt:unit UNITLESS, M ; w:stamp T
//   X a w:ConstantVelocity ; w:angular (3) ; w:linear (3) ; qudt:unit RAD-PER-SEC, M-PER-SEC
//                        (no numbers: the velocity of the last two entries)
//   X a w:Conveyor ;     w:linear (3) ; geom-coord:as-seen-by F ; qudt:unit M-PER-SEC
//   O a w:Object ;       w:attached-to F ; w:instance-of MODEL
//   T, D                 nodes with w:number and qudt:unit
//
// A pose that has coordinates and no measurement is static, provided by the model that says so. A
// value without a stamp is of the beginning of the clock.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/world/declared_scene.h"
#include "sinew/world/world.h"

namespace sinew::world {

// The provenance of poses whose model names none.
inline constexpr std::string_view kModelProvenance = "https://w3id.org/sinew/world#model";

// One edit: all of it or, when the report has errors, nothing. Frames that are there already by
// their IRI are used.
void load_scene(World& world, graph::Store& store, const graph::Places& places, Report& report);

// The contexts in which JSON-LD has a word for every term of a scene.
std::vector<std::string> scene_contexts();

// The way back, in SI units, into the default graph of `store`: what load_scene and read_scene make
// the same world of. Of a measurement the last entry is written, exactly, with its stamp.
//
// What a scene's model cannot say is a warning in the report, and left out: joints (their robot's
// model says them), quantities that are no poses, data blocks, models of prediction in code, the
// entries before the last.
struct SceneWriting {
  std::function<bool(RelationId)> leave_out = {};  // relations that other models say
};
void write_scene(const World& world, const DeclaredScene& scene, graph::Store& store,
                 Report& report, const SceneWriting& options = {});

}  // namespace sinew::world
