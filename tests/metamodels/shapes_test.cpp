// The shapes of our own metamodels: what the project writes conforms to them, and each thing that
// they ask for is missed when it is taken away.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "pipeline.h"
#include "sinew/blocks/graph.h"
#include "sinew/blocks/parser.h"
#include "sinew/model/load.h"
#include "sinew/model/tree.h"
#include "sinew/rdf/catalogue/catalogue.h"
#include "sinew/rdf/jsonld/load.h"
#include "sinew/rdf/shacl/report.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/rdf/turtle/reader.h"

namespace sinew {
namespace {

namespace fs = std::filesystem;

constexpr const char* kShapes = "https://w3id.org/sinew/shapes";
const fs::path kProject = SINEW_SOURCE_DIR;

std::string read(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<fs::path> files_in(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ending) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Everything that the project writes: the Gen3, its normalised tree, an algorithm, every named
// query with the sweeps and steps, scenes, and the example of the block language.
class Ours : public testing::Test {
 protected:
  Ours() {
    cli::ModelOptions options;
    for (const fs::path& file : files_in(kProject / "robots/gen3", ".jsonld")) {
      options.files.push_back(file.string());
    }
    models_ = cli::load(options);
    cli::QueryOptions query;
    query.solver = "rnea";
    cli::algorithm_of(*models_, options, query);
    graph::Store& store = models_->store;

    const catalogue::Catalogue catalogue;
    for (const char* folder : {"solvers", "solvers/sweeps", "solvers/steps"}) {
      for (const fs::path& file : files_in(kProject / folder, ".json")) {
        jsonld::Loader loader(catalogue);
        Report report;
        std::vector<graph::Quad> quads;
        loader.load(
            read(file), file.string(), store.terms(),
            [&](const graph::Quad& quad) { quads.push_back(quad); }, nullptr, report);
        report.throw_if_errors();
        for (const graph::Quad& quad : quads) store.add(quad);
      }
    }
    for (const char* folder : {"sinew/world/test/models", "examples/assembly_cell"}) {
      for (const fs::path& file : files_in(kProject / folder, ".jsonld")) {
        model::load_files({&file, 1}, {}, store, models_->places, scene_report_);
      }
    }
    for (const fs::path& file : files_in(kProject / "examples/conversions", ".blocks")) {
      blocks::to_graph(blocks::parse(read(file), file.string()),
                       "https://example.org/" + file.stem().string() + "/", store);
    }

    graph::Transaction transaction = store.begin();
    const graph::Id shapes = store.terms().iri(kShapes);
    for (const auto& [iri, document] : catalogue.documents()) {
      if (!iri.ends_with(".ttl")) continue;
      rdf::read_rdf(document.text, rdf::Syntax::kTurtle, {document.file, iri, {}}, store.terms(),
                    [&](const graph::Quad& quad, std::size_t, std::size_t) {
                      transaction.add({quad.subject, quad.predicate, quad.object, shapes});
                    });
    }
    transaction.commit();
  }

  // "conforms", or what does not.
  std::string report() {
    graph::Store& store = models_->store;
    const rdf::shacl::GraphReader graph(store.view(), store.terms().iri(kShapes));
    const auto shapes = rdf::shacl::parse_shapes(store, graph);
    return rdf::shacl::to_text(rdf::shacl::validate(shapes, rdf::shacl::GraphReader(store.view())),
                               store.terms());
  }
  void update(std::string_view text) {
    graph::Transaction transaction = models_->store.begin();
    const auto counts =
        rdf::sparql::update(transaction, models_->store.terms(),
                            "PREFIX tree: <https://w3id.org/sinew/kinematic-tree#> "
                            "PREFIX sa: <https://w3id.org/sinew/algorithm#> "
                            "PREFIX sq: <https://w3id.org/sinew/query#> "
                            "PREFIX ss: <https://w3id.org/sinew/step-model#> "
                            "PREFIX sg: <https://w3id.org/sinew/geometry#> "
                            "PREFIX data: <https://w3id.org/sinew/data#> "
                            "PREFIX rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> "
                            "PREFIX w: <https://w3id.org/sinew/world#> "
                            "PREFIX shape: <https://w3id.org/sinew/shape#> "
                            "PREFIX geom-coord: "
                            "<https://comp-rob2b.github.io/metamodels/geometry/coordinates#> "
                            "PREFIX qudt: <http://qudt.org/schema/qudt/> " +
                                std::string(text));
    transaction.commit();
    ASSERT_GT(counts.added + counts.removed, 0u) << text;
  }

  std::unique_ptr<cli::Models> models_;
  Report scene_report_;
};

TEST_F(Ours, ConformsToTheShapesOfEveryMetamodel) { EXPECT_EQ(report(), "conforms\n"); }

// Each node of a metamodel of ours is looked at: its type is the target of a shape.
TEST_F(Ours, EveryContextOfOursHasShapes) {
  const catalogue::Catalogue catalogue;
  for (const auto& [iri, document] : catalogue.documents()) {
    constexpr std::string_view kOurs = "https://w3id.org/sinew/";
    if (!iri.starts_with(kOurs) || !iri.ends_with(".json")) continue;
    const std::string shapes = iri.substr(0, iri.size() - 4) + "ttl";
    EXPECT_TRUE(catalogue.documents().contains(shapes)) << shapes;
  }
}

TEST_F(Ours, WhatIsTakenAwayIsMissed) {
  const auto take = [](const std::string& type, const std::string& property) {
    const std::string triple = " GRAPH ?g { ?x " + property + " ?y } ";
    return "DELETE {" + triple + "} WHERE { GRAPH ?any { ?x a " + type + " }" + triple + "}";
  };
  const std::pair<std::string, const char*> cases[] = {
      {take("tree:Body", "tree:frame"), "A body has one frame"},
      {take("tree:Body", "tree:contains"), "at least one link"},
      {take("tree:Joint", "tree:placement"), "kinematic-tree#placement"},
      {take("tree:Joint", "tree:index"), "kinematic-tree#index"},
      {take("tree:Coordinate", "qudt:unit"), "a unit for each of its parts"},
      {take("sa:Algorithm", "sa:schedule"), "algorithm#schedule"},
      {take("sa:DataBlock", "sa:role"), "algorithm#role"},
      {take("sa:DataBlock", "sa:size"), "algorithm#size"},
      {"DELETE WHERE { ?x sq:asks ?y }", "A query asks for something"},
      {"DELETE { ?x sq:quantity ?y } WHERE { ?x a sq:Asked ; sq:quantity ?y }", "has one quantity"},
      {"DELETE WHERE { ?x sq:steps ?y }", "query#steps"},
      {"INSERT DATA { <http://e/c> a sq:Given ; sq:quantity \"acceleration-constraint\" }",
       "directions, unit-forces or direction-inputs"},
      {"DELETE WHERE { ?x ss:gives ?y }", "A step gives something"},
      {"DELETE { ?x ss:compute ?y ; ss:configure ?z } WHERE { ?x ss:compute ?y ; ss:configure ?z }",
       "A visitor has a pass"},
      {"DELETE { ?x data:name ?y } WHERE { ?x a data:Prototype ; data:name ?y }", "needs one name"},
      {"DELETE { ?x data:text ?y } WHERE { ?x a data:Representation ; data:text ?y }", "data#text"},
      {"INSERT DATA { <http://e/d> a sg:DirectionReference }", "names one direction"},
      {take("w:Object", "w:attached-to"), "attached to one frame"},
      {take("w:Area", "w:shaped-as"), "An area has a shape"},
      {take("shape:Box", "qudt:unit"), "states the unit of its lengths"},
      {take("shape:Sphere", "geom-coord:as-seen-by"), "A shape is seen from one frame"},
      {take("shape:Sphere", "shape:radius"), "shape#radius"},
      {take("w:Polygon", "w:outline"), "world#outline"},
      {take("w:MeshBounds", "w:highest"), "world#highest"},
      {take("w:Measurement", "w:life-cycle"), "static, time-dependent or a prediction"},
      {take("w:Measurement", "w:provenance"), "names who provides it"},
      {take("w:PoseValue", "qudt:unit"), "The value of a pose states two units"},
      {take("w:PoseValue", "w:quaternion"), "world#quaternion"},
      {take("w:PoseCovariance", "qudt:unit"), "one of angles and one of lengths"},
      {take("w:PoseCovariance", "geom-coord:as-seen-by"), "seen from the frame whose pose it is"},
      {take("w:Conveyor", "w:linear"), "world#linear"},
      {take("w:Allowance", "w:what"), "world#what"},
      {take("w:RelationRule", "w:axes"), "along the axes of"},
      {"DELETE { GRAPH ?g { ?x qudt:unit ?y } } WHERE { GRAPH ?g { ?x w:measures ?q ; qudt:unit ?y "
       "} }",
       "A condition states its unit"},
      {"DELETE { GRAPH ?g { ?x qudt:unit ?y } } WHERE { GRAPH ?g { ?m w:validity ?x . ?x qudt:unit "
       "?y } }",
       "A number states its unit"},
  };
  graph::Store kept = models_->store.clone();
  for (const auto& [text, says] : cases) {
    models_->store = kept.clone();
    update(text);
    EXPECT_NE(report().find(says), std::string::npos) << text << "\n" << report();
  }
}

// Lists have the length of their quantity.
TEST_F(Ours, AListOfTheWrongLengthIsRefused) {
  update(
      "DELETE { GRAPH ?g { ?cell rdf:rest ?next } } INSERT { GRAPH ?g { ?cell rdf:rest rdf:nil } } "
      "WHERE { GRAPH ?g { ?joint a tree:Joint ; tree:placement/tree:value/rdf:rest ?cell . "
      "?cell rdf:rest ?next } }");
  EXPECT_NE(report().find("A placement is twelve numbers"), std::string::npos);
}

}  // namespace
}  // namespace sinew
