// A scene from models in a graph: frames and poses in the published vocabulary of geometry, and
// what Sinew adds, with `w:` = https://w3id.org/sinew/world#
//
//   pose relation        geom-rel:of, geom-rel:with-respect-to; w:measured-by M
//   M a w:Measurement ;  w:life-cycle "static" | "time-dependent" ; w:provenance P ;
//                        w:coord-frame F ; w:used-by U ; w:value C (coordinates of the pose) ;
//                        w:validity T, w:period T (nodes with w:number and qudt:unit)
//   O a w:Object ;       w:attached-to F ; w:instance-of MODEL
//
// A pose that has coordinates and no measurement is static, provided by the model that says so.
#pragma once

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/world/world.h"

namespace sinew::world {

// The provenance of poses whose model names none.
inline constexpr std::string_view kModelProvenance = "https://w3id.org/sinew/world#model";

// One edit: all of it or, when the report has errors, nothing. Frames that are there already by
// their IRI are used.
void load_scene(World& world, graph::Store& store, const graph::Places& places, Report& report);

}  // namespace sinew::world
