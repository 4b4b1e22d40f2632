// A scene from models in a graph: frames and poses in the published vocabulary of geometry, and
// what Sinew adds, with `w:` = https://w3id.org/sinew/world# (context: world.json there; shapes:
// world.ttl). This is the structure; declared_scene.h has shapes, covariances and rules, and
// declared_rights.h who may do what.
//
//   pose relation        geom-rel:of, geom-rel:with-respect-to; w:measured-by M
//                        or w:value V: static, provided by the model
//   M a w:Measurement ;  w:life-cycle "static" | "time-dependent" | "prediction" ; w:provenance P ;
//                        w:expiry T ;
//                        w:coord-frame F ; w:used-by U ; w:value V ; w:validity T ; w:period T ;
//                        w:interpolation "linear" | "screw" | "hold" ; w:deviation D ;
//                        w:entries 64 ; w:keeps-all true ; w:predicted-by X ; w:horizon T
//   V                    coordinates of the pose (geom-coord:PoseCoordinate), or
//   V a w:PoseValue ;    geom-coord:as-seen-by F ; w:position (x y z) ; w:quaternion (x y z w) ;
//                        qudt:unit UNITLESS, M ; w:stamp T
//   X a w:ConstantVelocity ; w:angular (3) ; w:linear (3) ; qudt:unit RAD-PER-SEC, M-PER-SEC
//                        (no numbers: the velocity of the last two entries)
//   X a w:ConstantAcceleration ; w:angular (3) ; w:linear (3) ; w:angular-rate (3) ;
//                        w:linear-rate (3) ; qudt:unit RAD-PER-SEC, M-PER-SEC, RAD-PER-SEC2,
//                        M-PER-SEC2
//   X a w:Conveyor ;     w:linear (3) ; geom-coord:as-seen-by F ; qudt:unit M-PER-SEC
//   O a w:Object ;       w:attached-to F ; w:instance-of MODEL
//
// Joints and what else than poses is measured, in SI units:
//
//   R a rel:Pose, w:Revolute | w:Prismatic ; w:placement V   the joint's frame, a PoseValue
//   R a w:Property ;     geom-rel:of F
//   M w:quantity "pose" | "twist" | "acceleration" | "joint-position" | "joint-velocity" |
//     "joint-acceleration" | "other" ; w:size n              n numbers, of "other"
//   V a w:Numbers ;      w:numbers (…) ; w:system "SI" ; w:stamp T ; geom-coord:as-seen-by F
//                        of what is no pose: in the order of the quantity (state.h) and in SI
//                        units, which is said; of a twist or an acceleration seen by the frame
//                        that moves
//   X of numbers         w:rates (…) ; w:system "SI", of a ConstantAcceleration w:accelerations (…)
//
// Data blocks (block_set.h): the same value in other prototypes. The library is a text in the block
// language, which whoever loads the scene knows to read (SceneReading).
//
//   M w:blocks (D …) ;   w:library "text" ; w:canonical "prototype"
//   D a w:DataBlock ;    w:prototype "ros_pose" ; w:realtime true ; w:allows-lossy true ;
//                        w:consistency M/data                what it is kept consistent with
//   T, D                 nodes with w:number and qudt:unit
//
// A pose that has coordinates and no measurement is static, provided by the model that says so. A
// value without a stamp is of the beginning of the clock.
#pragma once

#include <functional>
#include <memory>
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

struct SceneReading {
  // A checked library of prototypes from its text (blocks::load_library does it); may throw Error.
  // None: data blocks are an error of the model.
  std::function<std::shared_ptr<const data::Library>(const std::string& text)> read_library = {};
};

// One edit: all of it or, when the report has errors, nothing. Frames that are there already by
// their IRI are used.
void load_scene(World& world, graph::Store& store, const graph::Places& places, Report& report,
                const SceneReading& options = {});

// The contexts in which JSON-LD has a word for every term of a scene.
std::vector<std::string> scene_contexts();

// The way back, in SI units, into the default graph of `store`: what load_scene and read_scene make
// the same world of. Of a measurement the last entry is written, exactly, with its stamp.
//
// What a model cannot say is a warning in the report, and left out: models of prediction in code,
// and data blocks whose library has no text (BlocksSpec::library_text). Entries before the last are
// no part of a scene.
struct SceneWriting {
  std::function<bool(RelationId)> leave_out = {};  // relations that other models say
  // Measurements of which whoever writes may not have the value: each is a warning.
  std::function<bool(MeasurementId)> leave_out_values = {};
};
void write_scene(const World& world, const DeclaredScene& scene, graph::Store& store,
                 Report& report, const SceneWriting& options = {});

}  // namespace sinew::world
