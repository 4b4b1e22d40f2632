// URDF import: a robot's description in XML as a model in the graph, in the vocabulary of the
// published metamodels, one named graph for each concern: BASE/geometry, BASE/chain, BASE/dynamics,
// BASE/shapes.
//
// The IRIs are BASE/link/NAME, BASE/joint/NAME and BASE/frame/NAME (the link's own frame), with the
// URDF names as last segments; BASE/joint-frame/NAME is the joint's frame on its parent link. Names
// are percent-encoded where an IRI needs it.
#pragma once

#include <string>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"

namespace sinew::model {

struct UrdfOptions {
  // Empty: https://w3id.org/sinew/robots/ and the robot's name.
  std::string base_iri;
  // Elements that no URDF has are left out with a warning instead of an error.
  bool lenient = false;
};

// Adds the model of a URDF document, and where each of its elements is written. After an error in
// the report, nothing was added.
void import_urdf(std::string_view text, const std::string& file, const UrdfOptions& options,
                 graph::Terms& terms, graph::Transaction& transaction, graph::Places& places,
                 Report& report);

}  // namespace sinew::model
