// sinew check MODEL…: shapes, units, frames and physics in one report.
#include <algorithm>
#include <iostream>
#include <iterator>

#include "options.h"
#include "output.h"
#include "pipeline.h"
#include "sinew/blocks/elaborate.h"
#include "sinew/graph/standard_iris.h"
#include "sinew/model/normalise.h"
#include "sinew/rdf/catalogue/catalogue.h"
#include "sinew/rdf/shacl/report.h"
#include "sinew/rdf/shacl/shapes.h"
#include "sinew/rdf/shacl/validation.h"
#include "sinew/rdf/turtle/reader.h"
#include "sinew/vocab/vocab.h"
#include "sinew/world/declared_rights.h"
#include "sinew/world/declared_triggers.h"
#include "sinew/world/scene.h"

namespace sinew::cli {
namespace {

constexpr std::string_view kShapesGraph = "https://w3id.org/sinew/shapes";

// Puts a Turtle text of shapes into the graph of shapes.
void add_shapes(Models& models, graph::Id shapes_graph, std::string_view text,
                const std::string& file) {
  const std::uint32_t place = models.places.add_file(file);
  graph::Transaction transaction = models.store.begin();
  rdf::ReadOptions options;
  options.file = file;
  options.base = "file:///" + file;
  rdf::read_rdf(text, rdf::Syntax::kTurtle, options, models.store.terms(),
                [&](const graph::Quad& quad, std::size_t line, std::size_t column) {
                  transaction.add({quad.subject, quad.predicate, quad.object, shapes_graph});
                  models.places.note(quad.subject, quad.predicate, place,
                                     static_cast<std::uint32_t>(line),
                                     static_cast<std::uint32_t>(column));
                });
  transaction.commit();
}

// Every shape that ships with Sinew, that a --catalog adds, or that is named.
rdf::shacl::Shapes all_shapes(Models& models, const ModelOptions& options,
                              const std::vector<std::string>& files) {
  const graph::Id graph = models.store.terms().iri(kShapesGraph);
  catalogue::Catalogue catalogue;
  for (const std::string& folder : options.catalogs) catalogue.add_directory(folder);
  for (const auto& [iri, document] : catalogue.documents()) {
    if (iri.ends_with(".ttl")) add_shapes(models, graph, document.text, document.file);
  }
  for (const std::string& file : files) add_shapes(models, graph, read_input(file), file);
  return rdf::shacl::parse_shapes(models.store, rdf::shacl::GraphReader(models.store.view(), graph),
                                  &models.places);
}

bool has_type(const Models& models, std::string_view type) {
  const graph::Terms& terms = models.store.terms();
  const graph::Id is_a = terms.find_iri(graph::kRdfType), id = terms.find_iri(type);
  return is_a && id && bool(models.store.view().subject(is_a, id));
}
bool has_links(const Models& models) {
  return has_type(models, vocab::geom::SimplicialComplex) || has_type(models, vocab::kc::Joint);
}
// Whether there is something of which load_scene and what follows it makes a world.
bool has_scene(const Models& models) {
  constexpr std::string_view kTypes[] = {vocab::w::Object, vocab::w::Area, vocab::w::Measurement,
                                         vocab::w::PoseValue, vocab::w::RelationRule};
  return std::any_of(std::begin(kTypes), std::end(kTypes),
                     [&](std::string_view type) { return has_type(models, type); });
}

}  // namespace

int run_check(Arguments arguments) {
  CLI::App app(
      "Check models: conformance to the shapes of every metamodel, units, frames, and whether the "
      "robot is physically possible; of a scene, that it can be loaded. Prints every fault with "
      "its place.",
      "sinew check");
  ModelOptions models_options;
  std::vector<std::string> shape_files;
  std::string base, format = "text";
  bool only_shapes = false;
  add_model_options(app, models_options);
  app.add_option("--shapes", shape_files, "More SHACL shapes (Turtle); may be repeated");
  app.add_flag("--only-shapes", only_shapes, "Leave out units, frames and physics");
  app.add_option("--base", base, "Link or frame to start from (default: the only root)");
  app.add_option("--format", format, "text, or json for the report of the shapes")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  if (const auto code = parse(app, std::move(arguments))) return *code;

  const auto models = load(models_options);
  // Physics first: the shapes' own graph is no part of the robot.
  Report report(10'000);
  std::vector<std::string> notes;
  std::size_t bodies = 0, joints = 0;
  const bool is_scene = has_scene(*models);
  std::size_t frames = 0, objects = 0, shaped = 0;
  if (!only_shapes && is_scene) {
    world::World world;
    world::load_scene(
        world, models->store, models->places, report, {.read_library = [](const std::string& text) {
          return std::make_shared<const data::Library>(blocks::load_library(text, "data blocks"));
        }});
    if (!report.has_errors()) {
      const auto declared = world::read_scene(world, models->store, models->places, report);
      shaped = declared.bodies.size();
      world::read_triggers(world, declared, models->store, models->places, report);
      world::read_rights(models->store, models->places, report);
    }
    const world::State state = world.state();
    frames = state.frames.size();
    objects = state.objects.size();
  }
  const bool is_robot = has_links(*models) || !is_scene;
  if (!only_shapes && is_robot) {
    model::NormaliseOptions options;
    options.base = base;
    options.lenient = models_options.lenient;
    const model::Tree tree = model::normalise(models->store, models->places, options, report);
    notes = tree.notes;
    // As the model has them: a joint of several axes is one, with no bodies inside.
    bodies = tree.bodies.size();
    joints = tree.joints.size();
    for (const model::Tree::Compound& compound : tree.compounds) {
      bodies -= compound.parts.size() - 1;
      joints -= compound.parts.size() - 1;
    }
  }
  const rdf::shacl::Shapes shapes = all_shapes(*models, models_options, shape_files);
  const rdf::shacl::ValidationReport validation =
      rdf::shacl::validate(shapes, rdf::shacl::GraphReader(models->store.view()));
  if (format == "json") {
    write_output("",
                 rdf::shacl::to_json(validation, models->store.terms(), &models->places) + "\n");
  }
  for (Problem& problem :
       rdf::shacl::to_problems(validation, models->store.terms(), &models->places)) {
    report.add(std::move(problem));
  }

  for (const std::string& note : notes) std::cerr << "note: " << note << "\n";
  for (const Problem& problem : report.problems()) std::cerr << to_string(problem) << "\n";
  if (report.has_errors()) return kFault;
  if (format == "text") {
    std::cout << "conforms to " << shapes.shapes.size() << " shapes";
    if (!only_shapes && is_robot) {
      std::cout << "; " << bodies << " bodies, " << joints << " moving joints";
    }
    if (!only_shapes && is_scene) {
      std::cout << "; a scene of " << frames << " frames, " << objects << " objects, " << shaped
                << " with shapes";
    }
    std::cout << "\n";
  }
  return kOk;
}

}  // namespace sinew::cli
