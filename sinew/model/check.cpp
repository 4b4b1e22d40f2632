#include "sinew/model/check.h"

#include <optional>

#include "sinew/model/plausible.h"
#include "sinew/model/rigid_bodies.h"
#include "sinew/model/rotation.h"
#include "sinew/model/sizes.h"
#include "sinew/model/structure.h"
#include "sinew/rdf/shacl/report.h"
#include "sinew/rdf/turtle/reader.h"

namespace sinew::model {
namespace {

constexpr std::string_view kShapesGraph = "https://w3id.org/sinew/shapes";

// All shapes of the catalogue, read into a graph that is taken back at the end.
rdf::shacl::Shapes read_shapes(graph::Store& store, const catalogue::Catalogue& catalogue) {
  graph::Transaction transaction = store.begin();
  const graph::Id shapes_graph = store.terms().iri(kShapesGraph);
  graph::Places places;
  for (const auto& [iri, document] : catalogue.documents()) {
    if (!iri.ends_with(".ttl")) continue;
    const std::uint32_t file = places.add_file(document.file);
    rdf::ReadOptions options;
    options.file = document.file;
    options.base = iri;
    options.graph = shapes_graph;
    const auto sink = [&](const graph::Quad& quad, std::size_t line, std::size_t column) {
      transaction.add(quad);
      places.note(quad.subject, quad.predicate, file, static_cast<std::uint32_t>(line),
                  static_cast<std::uint32_t>(column));
    };
    rdf::read_rdf(document.text, rdf::Syntax::kTurtle, options, store.terms(), sink);
  }
  return rdf::shacl::parse_shapes(store, rdf::shacl::GraphReader(transaction.view(), shapes_graph),
                                  &places);
}

// Places all frames of all bodies, so that poses that disagree are found wherever they are.
void check_poses(graph::Store& store, const graph::Places& places, const Structure& structure,
                 Report& report) {
  const RigidBodies bodies = find_rigid_bodies(structure);
  std::vector<std::optional<Pose>> poses(structure.frames.size());
  for (std::size_t frame = 0; frame < poses.size(); ++frame) {
    if (poses[frame]) continue;
    place_frames(structure, bodies, store.terms(), places, static_cast<int>(frame), identity_pose(),
                 poses, report);
  }
  for (const Structure::Joint& joint : structure.joints) {
    if (joint.kind == JointKind::kFixed) continue;
    if (bodies.of_frame[joint.parent] != bodies.of_frame[joint.child]) continue;
    report.error(places.find(joint.iri), std::string(store.terms().text(joint.iri)),
                 "the joint connects two frames of the same rigid body",
                 "remove the constant pose or the fixed joint that makes them one, or the joint");
  }
}

}  // namespace

void check_shapes(graph::Store& store, const graph::Places& places,
                  const catalogue::Catalogue& catalogue, Report& report) {
  const rdf::shacl::Shapes shapes = read_shapes(store, catalogue);
  const rdf::shacl::ValidationReport found =
      rdf::shacl::validate(shapes, rdf::shacl::GraphReader(store.view()));
  for (Problem& problem : rdf::shacl::to_problems(found, store.terms(), &places)) {
    report.add(std::move(problem));
  }
}

void check_numbers(graph::Store& store, const graph::Places& places, Report& report) {
  const Structure structure = read_structure(store, places, report);
  check_sizes(structure, store.terms(), places, report);
  check_inertias(structure, store.terms(), places, false, report);
  check_limits(structure, store.terms(), places, report);
  check_poses(store, places, structure, report);
}

void check(graph::Store& store, const graph::Places& places, const catalogue::Catalogue& catalogue,
           Report& report) {
  check_shapes(store, places, catalogue, report);
  check_numbers(store, places, report);
}

}  // namespace sinew::model
