// Shapes, named areas, covariances and rules of scene models: read, answered from, written, and
// read again; and each fault with its file, line, element and remedy.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "random_poses.h"
#include "sinew/graph/store.h"
#include "sinew/model/load.h"
#include "sinew/rdf/catalogue/catalogue.h"
#include "sinew/rdf/isomorphism/isomorphism.h"
#include "sinew/rdf/jsonld/write.h"
#include "sinew/rdf/turtle/writer.h"
#include "sinew/world/edit.h"
#include "sinew/world/scene.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
struct LoadedScene {
  explicit LoadedScene(const model::Source& source) {
    model::load({&source, 1}, {}, store, places, report);
    report.throw_if_errors();
    load_scene(world, store, places, report);
    report.throw_if_errors();
    declared = read_scene(world, store, places, report);
    report.throw_if_errors();
  }
  FrameId frame(const std::string& name) const { return world.find_frame("http://shop/" + name); }

  graph::Store store;
  graph::Places places;
  Report report;
  World world;
  DeclaredScene declared;
};

const char* kWorkshop = SINEW_SOURCE_DIR "/sinew/world/test/models/workshop.jsonld";

std::vector<graph::Quad> written(const LoadedScene& scene, graph::Store& store) {
  Report report;
  write_scene(scene.world, scene.declared, store, report);
  EXPECT_TRUE(report.problems().empty()) << to_string(report.problems().front());
  return rdf::quads_of(store.view());
}

TEST(SceneModel, BodiesAreWhereTheModelPutsThem) {
  LoadedScene shop(model::read_source(kWorkshop));
  Space space(shop.world, shop.frame("room"));
  add_bodies(space, shop.declared);
  space.update(at_s(12.5));
  const BodyId bench = space.find("http://shop/bench");
  ASSERT_TRUE(space.is_placed(bench));
  // A quarter turn about z: the top's 1.2 m lie along the room's y, from 0.8 m down.
  const Bounds3 box = bounds(space.shapes(bench));
  EXPECT_NEAR(box.minimum.x, 2 - 0.4, 1e-12);
  EXPECT_NEAR(box.maximum.y, 1 + 0.6, 1e-12);
  EXPECT_NEAR(box.minimum.z, 0, 1e-12);
  EXPECT_NEAR(box.maximum.z, 0.8, 1e-12);
  // The cylinder is stated in millimetres, on a frame that is fixed to the part's: the camera looks
  // down from 2.3 m, sees the part 1.5 m away, and the lid is above it by 105 mm.
  const Bounds3 lid = bounds(space.shapes(space.find("http://shop/on-the-lid")));
  EXPECT_NEAR(lid.maximum.x - lid.minimum.x, 0.08, 1e-12);
  EXPECT_NEAR(lid.minimum.z, 2.3 - 1.5 + 0.1, 1e-12);
  // The mesh's bounds, turned by 45 degrees, are wider by the square root of two.
  const Bounds3 part = bounds(space.shapes(space.find("http://shop/part")));
  EXPECT_NEAR(part.maximum.x - part.minimum.x, 0.08 * std::numbers::sqrt2, 1e-12);
}

TEST(SceneModel, AreasAreAskedForByLabel) {
  LoadedScene shop(model::read_source(kWorkshop));
  Space space(shop.world, shop.frame("room"));
  add_bodies(space, shop.declared);
  space.update(at_s(12.5));
  const std::string area = shop.declared.find("storage magazine");
  EXPECT_EQ(area, "http://shop/magazine");
  EXPECT_EQ(shop.declared.find("http://shop/magazine"), area);
  EXPECT_EQ(shop.declared.find("nothing of the kind"), "");
  // The part is at (2.1, 1.3, 0.8): within the area, whose middle is (2, 1.4, 0.95).
  const auto inside = space.within(area, Match::kInside);
  std::vector<std::string> names;
  for (const BodyId body : inside.bodies) names.push_back(space.name(body));
  EXPECT_EQ(names, (std::vector<std::string>{"http://shop/part", "http://shop/on-the-lid"}));
}

TEST(SceneModel, PredictionsGoOnFromTheStatedStamp) {
  LoadedScene shop(model::read_source(kWorkshop));
  const PoseAnswer parcel = shop.world.pose(shop.frame("at-parcel"), shop.frame("room"), at_s(12));
  ASSERT_EQ(parcel.status, Status::kOk);
  EXPECT_NEAR(parcel.pose.p.x, 0.4, 1e-12);  // 0.2 m/s for 2 s
  EXPECT_EQ(shop.world.pose(shop.frame("at-parcel"), shop.frame("room"), at_s(21)).status,
            Status::kBeyondHorizon);
}

TEST(SceneModel, CovariancesAreThoseOfTheModelInSiUnits) {
  LoadedScene shop(model::read_source(kWorkshop));
  const Uncertainties known = uncertainties_of(shop.world, shop.declared);
  const UncertainPose seen = uncertain_pose(
      shop.world, {.of = shop.frame("at-part"), .with_respect_to = shop.frame("at-camera")}, known,
      at_s(12.5));
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen.pose.covariance(0, 0), std::pow(0.5 * kDegree, 2), 1e-18);
  EXPECT_NEAR(seen.pose.covariance(5, 5), 4e-6, 1e-18);
  // Nobody said how well the camera's own place is known.
  const UncertainPose unknown = uncertain_pose(
      shop.world, {.of = shop.frame("at-part"), .with_respect_to = shop.frame("room")}, known,
      at_s(12.5));
  EXPECT_EQ(unknown.undeclared, std::vector<std::string>{"http://shop/pose-camera/value"});
}

TEST(SceneModel, RulesJoinTheUsualOnes) {
  LoadedScene shop(model::read_source(kWorkshop));
  const std::vector<Rule> rules = rules_of(shop.declared);
  EXPECT_EQ(rules.size(), usual_rules().size() + 1);
  EXPECT_EQ(rules.back().name, "within-grasp");
  EXPECT_EQ(rules.back().axes, Axes::kSecond);
  EXPECT_DOUBLE_EQ(rules.back().conditions[0].maximum, 0.25);
  EXPECT_DOUBLE_EQ(rules.back().conditions[1].maximum, std::numbers::pi / 2);
  EXPECT_EQ(rules.back().conditions[1].minimum, -kUnbounded);
  Space space(shop.world, shop.frame("room"));
  add_bodies(space, shop.declared);
  space.update(at_s(12.5));
  const Relations relations = relations_of(space, shop.declared);
  // The camera declares a reach of 1500 mm; the part's lid is nearer, the parcel farther.
  const BodyId camera = space.find("http://shop/camera");
  const auto reachable = [&](const char* iri) {
    return relations.judge({.relation = "reachable", .first = space.find(iri), .second = camera});
  };
  EXPECT_TRUE(reachable("http://shop/on-the-lid").holds);
  EXPECT_FALSE(reachable("http://shop/parcel").holds);
}

// Loaded, written, loaded and written again: the same graph, the same answers to the last bit.
TEST(SceneModel, WhatIsWrittenReadsBackTheSame) {
  LoadedScene first(model::read_source(kWorkshop));
  graph::Store one;
  const auto quads = written(first, one);
  for (const rdf::Syntax syntax : {rdf::Syntax::kTurtle, rdf::Syntax::kNTriples}) {
    LoadedScene second({"again.ttl", rdf::write_rdf(quads, syntax, one.terms())});
    graph::Store two;
    const auto again = written(second, two);
    // Compared in one dictionary of terms.
    graph::Store terms;
    std::vector<graph::Quad> sides[2];
    const std::string texts[2] = {rdf::write_rdf(quads, rdf::Syntax::kNTriples, one.terms()),
                                  rdf::write_rdf(again, rdf::Syntax::kNTriples, two.terms())};
    for (int i = 0; i < 2; ++i) {
      rdf::read_rdf(
          texts[i], rdf::Syntax::kNTriples, {"side.nt", "", {}}, terms.terms(),
          [&, i](const graph::Quad& quad, std::size_t, std::size_t) { sides[i].push_back(quad); });
    }
    const rdf::Comparison comparison = rdf::compare_quads(sides[0], sides[1], terms.terms());
    EXPECT_TRUE(comparison) << comparison.difference;

    for (const char* frame : {"at-bench", "at-part", "at-parcel", "on-the-lid"}) {
      const PoseAnswer a = first.world.pose(first.frame(frame), first.frame("room"), at_s(12.7));
      const PoseAnswer b = second.world.pose(second.frame(frame), second.frame("room"), at_s(12.7));
      ASSERT_EQ(a.status, Status::kOk);
      EXPECT_EQ(difference(a.pose, b.pose), 0) << frame;
      EXPECT_EQ(a.freshness.expires, b.freshness.expires) << frame;
    }
    const auto model = second.world.model(second.world.find_measurement("http://shop/seen-part"));
    EXPECT_EQ(model->interpolation, Interpolation::kScrew);
    EXPECT_DOUBLE_EQ(model->standard_deviation, 0.003);
    EXPECT_EQ(model->used_by.size(), 2u);
    EXPECT_EQ(second.declared.labels, first.declared.labels);
  }
}

TEST(SceneModel, JsonLdHasAWordForEverything) {
  LoadedScene shop(model::read_source(kWorkshop));
  graph::Store out;
  written(shop, out);
  const catalogue::Catalogue catalogue;
  jsonld::WriteOptions options;
  options.contexts = scene_contexts();
  const std::string text = jsonld::Writer(catalogue, options).write_all(out.view());
  // Only Sinew's own contexts' names are left: no term of the scene is written as a whole IRI.
  EXPECT_EQ(text.find("\"https://w3id.org/sinew/world#"), std::string::npos) << text;
  LoadedScene again({"again.jsonld", text});
  EXPECT_EQ(again.declared.bodies.size(), shop.declared.bodies.size());
  EXPECT_EQ(again.declared.covariances.size(), shop.declared.covariances.size());
}

// ---- what an attachment leaves behind ----

TEST(SceneModel, AnAttachedPartIsStillAttachedWhenItIsReadBack) {
  LoadedScene shop(model::read_source(kWorkshop));
  shop.world.attach(shop.frame("at-part"), shop.frame("at-parcel"), at_s(12.5), "http://shop/hand");
  graph::Store out;
  const auto quads = written(shop, out);
  LoadedScene again({"again.ttl", rdf::write_rdf(quads, rdf::Syntax::kTurtle, out.terms())});
  for (LoadedScene* scene : {&shop, &again}) {
    // Carried by the parcel, 0.2 m/s; what the camera says is suspended.
    const PoseAnswer part =
        scene->world.pose(scene->frame("at-part"), scene->frame("room"), at_s(14.5));
    ASSERT_EQ(part.status, Status::kOk);
    EXPECT_NEAR(part.pose.p.x, 2.1 + 0.4, 1e-12);
    scene->world.detach(scene->frame("at-part"), scene->frame("room"), at_s(14.5),
                        "http://shop/hand");
    EXPECT_NEAR(scene->world.pose(scene->frame("at-part"), scene->frame("room"), at_s(15)).pose.p.x,
                2.5, 1e-12);
  }
}

TEST(SceneModel, AJointIsWrittenUnlessItIsLeftOut) {
  World world;
  const FrameId a = world.add_frame("http://shop/a"), b = world.add_frame("http://shop/b");
  const RelationId joint = world.add_relation({.name = "http://shop/joint",
                                               .of = b,
                                               .with_respect_to = a,
                                               .kind = RelationKind::kRevolute});
  world.add_measurement(
      {.name = "http://shop/angle", .relation = joint, .quantity = Quantity::kJointPosition});
  graph::Store out;
  Report report;
  write_scene(world, {}, out, report);
  EXPECT_TRUE(report.problems().empty());
  const auto says = [](graph::Store& store) {
    return bool(store.view().subject(store.terms().iri("https://w3id.org/sinew/world#measured-by"),
                                     store.terms().iri("http://shop/angle")));
  };
  EXPECT_TRUE(says(out));
  graph::Store without;
  Report quiet;
  write_scene(world, {}, without, quiet, {.leave_out = [&](RelationId id) { return id == joint; }});
  EXPECT_TRUE(quiet.problems().empty());
  EXPECT_FALSE(says(without));
}

// ---- faults ----

struct Fault {
  const char* what_for;
  const char* text;
  const char* iri;
  const char* says;
  const char* remedy;
};

class SceneFault : public testing::TestWithParam<Fault> {};

TEST_P(SceneFault, HasAPlaceAnElementAndARemedy) {
  graph::Store store;
  graph::Places places;
  Report report;
  const std::string header =
      "@prefix w: <https://w3id.org/sinew/world#> . @prefix x: <http://x/> .\n"
      "@prefix shape: <https://w3id.org/sinew/shape#> .\n"
      "@prefix unit: <http://qudt.org/vocab/unit/> . @prefix qudt: <http://qudt.org/schema/qudt/> "
      ".\n"
      "@prefix geom: <https://comp-rob2b.github.io/metamodels/geometry/structural-entities#> .\n"
      "@prefix c: <https://comp-rob2b.github.io/metamodels/geometry/coordinates#> .\n"
      "@prefix rel: <https://comp-rob2b.github.io/metamodels/geometry/spatial-relations#> .\n"
      "x:a a geom:Frame . x:b a geom:Frame .\n"
      "x:p a rel:Pose ; rel:of x:b ; rel:with-respect-to x:a ; w:measured-by x:m .\n"
      "x:m a w:Measurement ; w:life-cycle \"time-dependent\" ; w:provenance x:camera .\n"
      "x:o a w:Object ; w:attached-to x:b .\n";
  const model::Source source{"fault.ttl", header + GetParam().text};
  model::load({&source, 1}, {}, store, places, report);
  ASSERT_TRUE(report.problems().empty()) << to_string(report.problems().front());
  World world;
  load_scene(world, store, places, report);
  if (!report.has_errors()) read_scene(world, store, places, report);
  ASSERT_TRUE(report.has_errors()) << GetParam().what_for;
  const Problem& problem = report.problems().front();
  EXPECT_EQ(problem.place.file, "fault.ttl");
  EXPECT_GE(problem.place.line, 8u);  // where the prefixes end
  EXPECT_EQ(problem.iri, GetParam().iri);
  EXPECT_NE(problem.what.find(GetParam().says), std::string::npos) << problem.what;
  EXPECT_NE(problem.remedy.find(GetParam().remedy), std::string::npos) << problem.remedy;
}

const Fault kFaults[] = {
    {"NegativeSize",
     "x:o w:shaped-as x:s .\n"
     "x:s a shape:Box ; shape:size (0.1 -0.2 0.1) ; c:as-seen-by x:b ; qudt:unit unit:M .",
     "http://x/s", "the box's size along y is -0.2", "above 0 m"},
    {"NegativeRadius",
     "x:o w:shaped-as x:s .\n"
     "x:s a shape:Sphere ; shape:radius -1 ; c:as-seen-by x:b ; qudt:unit unit:M .",
     "http://x/s", "the sphere's radius is -1", "above 0 m"},
    {"MissingUnit",
     "x:o w:shaped-as x:s .\n"
     "x:s a shape:Box ; shape:size (0.1 0.2 0.1) ; c:as-seen-by x:b .",
     "http://x/s", "has no unit", "state a unit"},
    {"UnitOfTheWrongKind",
     "x:o w:shaped-as x:s .\n"
     "x:s a shape:Box ; shape:size (0.1 0.2 0.1) ; c:as-seen-by x:b ; qudt:unit unit:SEC .",
     "http://x/s", "no stated unit fits", "state a unit"},
    {"NotSeenByAnyFrame",
     "x:o w:shaped-as x:s .\nx:s a shape:Box ; shape:size (0.1 0.2 0.1) ; qudt:unit unit:M .",
     "http://x/s", "the frame that the shape is seen by is missing", "exactly once"},
    {"TwoNumbersForThree",
     "x:o w:shaped-as x:s .\n"
     "x:s a shape:Box ; shape:size (0.1 0.2) ; c:as-seen-by x:b ; qudt:unit unit:M .",
     "http://x/s", "no list of 3 finite numbers", "write 3 numbers"},
    {"TwoKindsOfShape",
     "x:o w:shaped-as x:s .\n"
     "x:s a shape:Box, shape:Sphere ; shape:size (1 1 1) ; c:as-seen-by x:b ; qudt:unit unit:M .",
     "http://x/s", "several kinds", "one of Box"},
    {"MeshFile",
     "x:o w:shaped-as x:s .\n"
     "x:s a shape:Mesh ; shape:file \"a.stl\" ; c:as-seen-by x:b ; qudt:unit unit:M .",
     "http://x/s", "a relative path, and it is not said to what", "the directory of meshes"},
    {"PolygonThatCrossesItself",
     "x:o w:shaped-as x:s .\n"
     "x:s a w:Polygon ; w:outline ((0 0) (1 1) (1 0) (0 1)) ; w:bottom 0 ; w:top 1 ;\n"
     "  c:as-seen-by x:b ; qudt:unit unit:M .",
     "http://x/s", "crosses itself: side 0 meets side 2", "convex"},
    {"PolygonThatIsNotConvex",
     "x:o w:shaped-as x:s .\n"
     "x:s a w:Polygon ; w:outline ((0 0) (2 0) (1 0.5) (2 2)) ; w:bottom 0 ; w:top 1 ;\n"
     "  c:as-seen-by x:b ; qudt:unit unit:M .",
     "http://x/s", "not convex and anticlockwise at corner 2", "several"},
    {"PolygonUpsideDown",
     "x:o w:shaped-as x:s .\n"
     "x:s a w:Polygon ; w:outline ((0 0) (1 0) (1 1)) ; w:bottom 1 ; w:top 0 ;\n"
     "  c:as-seen-by x:b ; qudt:unit unit:M .",
     "http://x/s", "the polygon's height is -1", "above 0 m"},
    {"CornerOfThreeNumbers",
     "x:o w:shaped-as x:s .\n"
     "x:s a w:Polygon ; w:outline ((0 0) (1 0 0) (1 1)) ; w:bottom 0 ; w:top 1 ;\n"
     "  c:as-seen-by x:b ; qudt:unit unit:M .",
     "http://x/s", "corner 1 of the outline", "[[x, y]"},
    {"MeshBoundsOutOfOrder",
     "x:o w:shaped-as x:s .\n"
     "x:s a w:MeshBounds ; w:lowest (0 0 1) ; w:highest (1 1 0) ; c:as-seen-by x:b ;\n"
     "  qudt:unit unit:M .",
     "http://x/s", "not in order", "minimum below maximum"},
    {"QuaternionOfAnotherLength",
     "x:o w:shaped-as x:s .\n"
     "x:s a shape:Box ; shape:size (1 1 1) ; w:quaternion (0 0 1 1) ; c:as-seen-by x:b ;\n"
     "  qudt:unit unit:M, unit:UNITLESS .",
     "http://x/s", "not of unit length", "x y z w"},
    {"AreaWithoutShape", "x:z a w:Area ; w:attached-to x:a .", "http://x/z",
     "an area without a shape", "a shape"},
    {"AreaOnNoFrame",
     "x:z a w:Area ; w:attached-to x:nowhere ; w:shaped-as x:s .\n"
     "x:s a shape:Box ; shape:size (1 1 1) ; c:as-seen-by x:b ; qudt:unit unit:M .",
     "http://x/z", "no frame of this world", "a Frame"},
    {"CovarianceNotSymmetric",
     "x:m w:covariance x:k . x:k a w:PoseCovariance ; c:as-seen-by x:b ;\n"
     "  qudt:unit unit:RAD, unit:M ; w:matrix (1 0.5 0 0 0 0  0 1 0 0 0 0  0 0 1 0 0 0\n"
     "  0 0 0 1 0 0  0 0 0 0 1 0  0 0 0 0 0 1) .",
     "http://x/k", "not symmetric: entry (2, 1) is 0, and (1, 2) is 0.5", "both sides"},
    {"CovarianceNotPositive",
     "x:m w:covariance x:k . x:k a w:PoseCovariance ; c:as-seen-by x:b ;\n"
     "  qudt:unit unit:RAD, unit:M ; w:matrix (1 2 0 0 0 0  2 1 0 0 0 0  0 0 1 0 0 0\n"
     "  0 0 0 1 0 0  0 0 0 0 1 0  0 0 0 0 0 1) .",
     "http://x/k", "the variance is negative", "positive semidefinite"},
    {"CovarianceSeenFromElsewhere",
     "x:m w:covariance x:k . x:k a w:PoseCovariance ; c:as-seen-by x:a ;\n"
     "  qudt:unit unit:RAD, unit:M ; w:angular-deviation 0.1 ; w:linear-deviation 0.1 .",
     "http://x/k", "seen by http://x/a", "http://x/b"},
    {"CovarianceWithOneUnit",
     "x:m w:covariance x:k . x:k a w:PoseCovariance ; c:as-seen-by x:b ;\n"
     "  qudt:unit unit:M ; w:angular-deviation 0.1 ; w:linear-deviation 0.1 .",
     "http://x/k", "the covariance's angles", "state a unit"},
    {"NegativeDeviation",
     "x:m w:covariance x:k . x:k a w:PoseCovariance ; c:as-seen-by x:b ;\n"
     "  qudt:unit unit:RAD, unit:M ; w:angular-deviation 0.1 ; w:linear-deviation -0.1 .",
     "http://x/k", "a deviation of -0.1", "none is below zero"},
    {"CovarianceOfNothing",
     "x:o w:covariance x:k . x:k a w:PoseCovariance ; c:as-seen-by x:b ;\n"
     "  qudt:unit unit:RAD, unit:M ; w:angular-deviation 0.1 ; w:linear-deviation 0.1 .",
     "http://x/o", "is no measurement", "a Measurement"},
    {"JointCovarianceOfAPose",
     "x:m w:covariance x:k . x:k a w:JointCovariance ; w:number 0.1 ; qudt:unit unit:RAD .",
     "http://x/m", "does not fit", "a PoseCovariance"},
    {"RuleOfAnUnknownQuantity",
     "x:r a w:RelationRule ; w:called \"beside\" ; w:axes \"space\" ; w:bodies 2 ;\n"
     "  w:condition x:k . x:k w:measures \"colour\" ; w:maximum 1 ; qudt:unit unit:M .",
     "http://x/k", "no quantity 'colour'", "distance"},
    {"RuleWithBoundsOutOfOrder",
     "x:r a w:RelationRule ; w:called \"beside\" ; w:axes \"space\" ; w:bodies 2 ;\n"
     "  w:condition [ w:measures \"distance\" ; w:minimum 2 ; w:maximum 1 ; qudt:unit unit:M ] .",
     "http://x/r", "not in order", "minimum"},
    {"RuleOfThreeForTwo",
     "x:r a w:RelationRule ; w:called \"beside\" ; w:axes \"space\" ; w:bodies 2 ;\n"
     "  w:condition [ w:measures \"share-of-way\" ; w:minimum 0 ; qudt:unit unit:UNITLESS ] .",
     "http://x/r", "between three bodies", "ternary"},
    {"RuleAlongUnknownAxes",
     "x:r a w:RelationRule ; w:called \"beside\" ; w:axes \"moon\" ; w:bodies 2 ;\n"
     "  w:condition [ w:measures \"distance\" ; w:maximum 1 ; qudt:unit unit:M ] .",
     "http://x/r", "no axes 'moon'", "space, second or viewer"},
    {"BoundWithoutUnit",
     "x:r a w:RelationRule ; w:called \"beside\" ; w:axes \"space\" ; w:bodies 2 ;\n"
     "  w:condition x:k . x:k w:measures \"distance\" ; w:maximum 1 .",
     "http://x/k", "the bounds has no unit", "state a unit"},
    {"NumberThatNobodyAsksFor",
     "x:o w:shaped-as x:s ; w:declares x:n . x:n w:property \"mood\" ; w:number 1 ;\n"
     "  qudt:unit unit:M .\n"
     "x:s a shape:Box ; shape:size (1 1 1) ; c:as-seen-by x:b ; qudt:unit unit:M .",
     "http://x/n", "no rule asks for 'mood'", "reach"},
    {"PredictionWithoutModel",
     "x:q a rel:Pose ; rel:of x:b ; rel:with-respect-to x:a ; w:measured-by x:n .\n"
     "x:n a w:Measurement ; w:life-cycle \"prediction\" ; w:provenance x:camera .",
     "http://x/n", "the model of a prediction is missing", "exactly once"},
    {"ModelWithoutPrediction",
     "x:q a rel:Pose ; rel:of x:b ; rel:with-respect-to x:a ; w:measured-by x:n .\n"
     "x:n a w:Measurement ; w:life-cycle \"static\" ; w:provenance x:camera ;\n"
     "  w:predicted-by [ a w:ConstantVelocity ] .",
     "http://x/n", "a model of prediction for", "prediction"},
    {"UnknownInterpolation",
     "x:q a rel:Pose ; rel:of x:b ; rel:with-respect-to x:a ; w:measured-by x:n .\n"
     "x:n a w:Measurement ; w:life-cycle \"static\" ; w:provenance x:c ; w:interpolation \"cubic\" "
     ".",
     "http://x/n", "no interpolation 'cubic'", "linear, screw or hold"},
    {"NoEntries",
     "x:q a rel:Pose ; rel:of x:b ; rel:with-respect-to x:a ; w:measured-by x:n .\n"
     "x:n a w:Measurement ; w:life-cycle \"time-dependent\" ; w:provenance x:c ; w:entries 0 .",
     "http://x/n", "0 entries", "1 to"},
    {"ValueSeenFromElsewhere",
     "x:q a rel:Pose ; rel:of x:b ; rel:with-respect-to x:a ; w:value x:v .\n"
     "x:v a w:PoseValue ; c:as-seen-by x:b ; w:position (0 0 0) ; w:quaternion (0 0 0 1) ;\n"
     "  qudt:unit unit:M, unit:UNITLESS .",
     "http://x/v", "seen by http://x/b", "with respect to which it is"},
    {"MeasurementOfTwoRelations",
     "x:q a rel:Pose ; rel:of x:b ; rel:with-respect-to x:a ; w:measured-by x:m .", "http://x/m",
     "", ""},
    {"ObjectOnNoFrame", "x:z a w:Object ; w:attached-to x:o .", "http://x/z", "which is no frame",
     "a Frame"},
    {"MeasuredPoseOfNoFrame",
     "x:q a rel:Pose ; rel:of x:o ; rel:with-respect-to x:a ; w:measured-by x:n .\n"
     "x:n a w:Measurement ; w:life-cycle \"static\" ; w:provenance x:c .",
     "http://x/q", "not between two frames", "each a Frame"},
};

INSTANTIATE_TEST_SUITE_P(EachKind, SceneFault, testing::ValuesIn(kFaults),
                         [](const auto& info) { return std::string(info.param.what_for); });

// What a limit refuses: an outline with too many corners, also one whose list never ends.
TEST(SceneModel, OutlinesAreReadUpToALimit) {
  const auto load_outline = [](const std::string& outline) {
    const model::Source source{
        "long.ttl",
        "@prefix w: <https://w3id.org/sinew/world#> . @prefix x: <http://x/> .\n"
        "@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .\n"
        "@prefix unit: <http://qudt.org/vocab/unit/> .\n"
        "@prefix qudt: <http://qudt.org/schema/qudt/> .\n"
        "@prefix geom: <https://comp-rob2b.github.io/metamodels/geometry/structural-entities#> .\n"
        "@prefix c: <https://comp-rob2b.github.io/metamodels/geometry/coordinates#> .\n"
        "x:a a geom:Frame ; w:shaped-as x:s . x:s a w:Polygon ; w:bottom 0 ; w:top 1 ;\n"
        "  c:as-seen-by x:a ; qudt:unit unit:M ; w:outline " +
            outline};
    graph::Store store;
    graph::Places places;
    Report report;
    model::load({&source, 1}, {}, store, places, report);
    report.throw_if_errors();
    World world;
    load_scene(world, store, places, report);
    read_scene(world, store, places, report);
    return report.problems().empty() ? std::string() : to_string(report.problems().front());
  };
  const auto circle = [](std::size_t corners) {
    std::string text = "(";
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle =
          2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
      text += "(" + std::to_string(1000 * std::cos(angle)) + " " +
              std::to_string(1000 * std::sin(angle)) + ") ";
    }
    return text + ") .";
  };
  EXPECT_EQ(load_outline(circle(kMaximumPolygonCorners)), "");
  EXPECT_NE(load_outline(circle(kMaximumPolygonCorners + 1)).find("more than 1000 corners"),
            std::string::npos);
  EXPECT_NE(load_outline("x:l . x:l rdf:first (0 0) ; rdf:rest x:l .").find("more than 1000"),
            std::string::npos);
}

}  // namespace
}  // namespace sinew::world
