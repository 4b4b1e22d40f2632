// Whether a model is fit to be used, before anything is made from it: conformance to the metamodels
// (their SHACL shapes), units and their dimensions, frames that every number needs, poses that
// agree, and physical plausibility. Every fault is reported with its place and a remedy.
//
// `normalise` makes those of these checks that concern what it uses; this makes all of them, also
// for the parts of a model that no query has asked for.
#pragma once

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/rdf/catalogue/catalogue.h"

namespace sinew::model {

// The store holds the model; it is not changed, but its dictionary grows.
void check(graph::Store& store, const graph::Places& places, const catalogue::Catalogue& catalogue,
           Report& report);

// The parts of it: conformance to every shapes document (.ttl) of the catalogue, and what needs
// numbers.
void check_shapes(graph::Store& store, const graph::Places& places,
                  const catalogue::Catalogue& catalogue, Report& report);
void check_numbers(graph::Store& store, const graph::Places& places, Report& report);

}  // namespace sinew::model
