// The qualitative relations of a scene that is a model: nine of them, true and false, whatever the
// way the whole scene is turned, as seen by somebody and by somebody on the other side; as facts
// that SPARQL finds; and with the numbers that made them so.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <set>

#include "sinew/model/load.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/world/qualitative_facts.h"
#include "sinew/world/scene.h"

namespace sinew::world {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Each thing has a frame of its own, at (x, y, z) in the kitchen and turned about z.
struct Thing {
  const char* name;
  double x, y, z, yaw_degrees;
  const char* shape;
  const char* more = "";
};

// A table with a cup, a bowl with a ball in it, a vase and a plate on it; a lamp above; a robot; a
// car whose front points along the kitchen's y, with somebody or something on each of its sides.
const Thing kThings[] = {
    {"table", 0, 0, 0.75, 0, "a shape:Box ; shape:size (1.6 0.8 0.05) ; w:position (0 0 -0.025)"},
    {"cup", 0.3, 0.1, 0.75, 70,
     "a shape:Cylinder ; shape:radius 0.04 ; shape:length 0.1 ; w:position (0 0 0.05)"},
    {"bowl", -0.3, 0, 0.75, 0, "a shape:Box ; shape:size (0.3 0.3 0.2) ; w:position (0 0 0.1)"},
    {"ball", -0.3, 0.05, 0.85, 10, "a shape:Sphere ; shape:radius 0.03"},
    {"vase", 0.7, 0.1, 0.75, 45,
     "a w:Polygon ; w:outline ((-0.05 -0.05) (0.05 -0.05) (0 0.05)) ; w:bottom 0 ; w:top 0.3"},
    {"plate", 0.3, -0.25, 0.75, 0,
     "a shape:Cylinder ; shape:radius 0.1 ; shape:length 0.02 ; w:position (0 0 0.01)"},
    {"lamp", 0, 0, 1.6, 20, "a shape:Box ; shape:size (0.2 0.2 0.2)"},
    {"robot", -1.5, 0, 0, 0,
     "a shape:Cylinder ; shape:radius 0.2 ; shape:length 0.4 ; w:position (0 0 0.2)",
     "w:declares [ w:property \"reach\" ; w:number 2000 ; qudt:unit unit:MilliM ] ;"},
    {"car", 0, 5, 0.5, 90, "a w:MeshBounds ; w:lowest (-1 -0.5 -0.5) ; w:highest (1 0.5 0.5)"},
    {"child", 0, 7, 0.5, 0, "a shape:Box ; shape:size (0.3 0.3 1)"},
    {"trailer", 0, 3, 0.5, 0, "a shape:Box ; shape:size (0.8 1 1)"},
    {"post", -1.5, 5, 0.5, 0, "a shape:Box ; shape:size (0.2 0.2 1)"},
    {"bin", 1.5, 5, 0.5, 0, "a shape:Box ; shape:size (0.4 0.4 1)"},
};

std::string model_text(double kitchen_yaw) {
  std::string text =
      "@prefix w: <https://w3id.org/sinew/world#> . @prefix x: <http://x/> .\n"
      "@prefix shape: <https://w3id.org/sinew/shape#> .\n"
      "@prefix unit: <http://qudt.org/vocab/unit/> .\n"
      "@prefix qudt: <http://qudt.org/schema/qudt/> .\n"
      "@prefix geom: <https://comp-rob2b.github.io/metamodels/geometry/structural-entities#> .\n"
      "@prefix c: <https://comp-rob2b.github.io/metamodels/geometry/coordinates#> .\n"
      "@prefix rel: <https://comp-rob2b.github.io/metamodels/geometry/spatial-relations#> .\n"
      "x:house a geom:Frame .\n";
  const auto frame = [&](const std::string& name, const std::string& parent, double x, double y,
                         double z, double yaw) {
    text += fmt::format(
        "x:{0} a geom:Frame . x:pose-{0} a rel:Pose ; rel:of x:{0} ; rel:with-respect-to x:{1} ;\n"
        "  w:value [ a w:PoseValue ; c:as-seen-by x:{1} ; qudt:unit unit:UNITLESS, unit:M ;\n"
        "    w:position ({2:.17e} {3:.17e} {4:.17e}) ; w:quaternion (0 0 {5:.17e} {6:.17e}) ] .\n",
        name, parent, x, y, z, std::sin(yaw / 2), std::cos(yaw / 2));
  };
  frame("kitchen", "house", 3, -2, 0.4, kitchen_yaw);
  frame("cook", "kitchen", 0, -3, 1.6, 90 * kDegree);   // looks along the kitchen's y
  frame("guest", "kitchen", 0, 3, 1.6, -90 * kDegree);  // from the other side
  for (const Thing& thing : kThings) {
    const std::string at = std::string("at-") + thing.name;
    frame(at, "kitchen", thing.x, thing.y, thing.z, thing.yaw_degrees * kDegree);
    text += fmt::format(
        "x:{0} a w:Object ; w:attached-to x:{1} ; {3} w:shaped-as [ {2} ;\n"
        "  c:as-seen-by x:{1} ; qudt:unit unit:M ] .\n",
        thing.name, at, thing.shape, thing.more);
  }
  return text;
}

struct Kitchen {
  explicit Kitchen(double yaw) {
    const model::Source source{"kitchen.ttl", model_text(yaw)};
    model::load({&source, 1}, {}, store, places, report);
    report.throw_if_errors();
    load_scene(world, store, places, report);
    report.throw_if_errors();
    scene = read_scene(world, store, places, report);
    report.throw_if_errors();
    space = std::make_unique<Space>(world, world.find_frame("http://x/house"));
    add_bodies(*space, scene);
    space->update(Stamp());
  }
  Judgement judge(const Relations& relations, const std::string& first, const std::string& relation,
                  const std::string& second, const std::string& third, const char* viewer) const {
    const auto body = [&](const std::string& name) {
      return name.empty() ? BodyId{} : space->find("http://x/" + name);
    };
    return relations.judge(
        {.relation = relation,
         .first = body(first),
         .second = body(second),
         .third = body(third),
         .viewer = *viewer ? world.find_frame(std::string("http://x/") + viewer) : FrameId{}});
  }
  graph::Store store;
  graph::Places places;
  Report report;
  World world;
  DeclaredScene scene;
  std::unique_ptr<Space> space;
};

struct Case {
  const char *first, *relation, *second;
  bool holds;
  const char *third = "", *viewer = "";
};

const Case kCases[] = {
    {"cup", "on", "table", true},
    {"ball", "on", "table", false},
    {"lamp", "on", "table", false},
    {"table", "on", "cup", false},
    {"lamp", "above", "table", true},
    {"cup", "above", "table", false},
    {"table", "above", "lamp", false},
    {"ball", "in", "bowl", true},
    {"cup", "in", "bowl", false},
    {"bowl", "in", "ball", false},
    {"cup", "near", "plate", true},
    {"cup", "near", "bowl", false},
    {"child", "in-front-of", "car", true},
    {"trailer", "in-front-of", "car", false},
    {"trailer", "behind", "car", true},
    {"post", "left-of", "car", true},
    {"bin", "left-of", "car", false},
    {"bin", "right-of", "car", true},
    {"post", "right-of", "car", false},
    {"bowl", "left-of-as-seen", "cup", true, "", "cook"},
    {"bowl", "left-of-as-seen", "cup", false, "", "guest"},
    {"bowl", "right-of-as-seen", "cup", true, "", "guest"},
    {"vase", "right-of-as-seen", "cup", true, "", "cook"},
    {"plate", "in-front-of-as-seen", "cup", true, "", "cook"},
    {"plate", "in-front-of-as-seen", "cup", false, "", "guest"},
    {"cup", "in-front-of-as-seen", "plate", true, "", "guest"},
    {"cup", "between", "bowl", true, "vase"},
    {"lamp", "between", "bowl", false, "vase"},
    {"vase", "between", "bowl", false, "cup"},
    {"bowl", "reachable", "robot", true},
    {"lamp", "reachable", "robot", false},
    {"child", "reachable", "robot", false},
};

class TurnedKitchen : public testing::TestWithParam<int> {};

TEST_P(TurnedKitchen, AllRelationsHoldAsTheyShould) {
  const Kitchen kitchen(GetParam() * kDegree);
  const Relations relations = relations_of(*kitchen.space, kitchen.scene);
  std::set<std::string> asked;
  for (const Case& c : kCases) {
    const Judgement judgement =
        kitchen.judge(relations, c.first, c.relation, c.second, c.third, c.viewer);
    ASSERT_EQ(judgement.status, Status::kOk);
    EXPECT_EQ(judgement.holds, c.holds) << explain(judgement);
    EXPECT_FALSE(judgement.findings.empty());
    if (c.holds) asked.insert(c.relation);
  }
  EXPECT_EQ(asked.size(), usual_rules().size()) << "each rule was seen to hold";
}

// The same, stated in a graph: what is found is what judge says, of every pair.
TEST_P(TurnedKitchen, FactsAreFoundBySparqlWithWhatMadeThemTrue) {
  Kitchen kitchen(GetParam() * kDegree);
  const Relations relations = relations_of(*kitchen.space, kitchen.scene);
  const FrameId cook = kitchen.world.find_frame("http://x/cook");
  const StatedFacts stated = state_facts(relations, *kitchen.space, kitchen.store, cook);
  EXPECT_TRUE(stated.left_out.empty());
  EXPECT_TRUE(stated.unplaced.empty());
  const auto ask = [&](const std::string& text) {
    return rdf::sparql::query(
        kitchen.store.view(), kitchen.store.terms(),
        "PREFIX w: <https://w3id.org/sinew/world#> PREFIX x: <http://x/> " + text, {});
  };
  for (const Case& c : kCases) {
    if (std::string(c.viewer) == "guest") continue;
    const std::string first = std::string("x:") + c.first, second = std::string("x:") + c.second;
    const std::string text =
        *c.third ? fmt::format(
                       "ASK {{ ?f w:called \"{}\" ; w:first {} ; w:second ?a ; w:third ?b "
                       "FILTER ((?a = {} && ?b = x:{}) || (?b = {} && ?a = x:{})) }}",
                       c.relation, first, second, c.third, second, c.third)
                 : fmt::format("ASK {{ {} w:{} {} }}", first, c.relation, second);
    EXPECT_EQ(ask(text).results.boolean, c.holds) << text;
  }
  const auto why =
      ask("SELECT ?because WHERE { ?f w:called \"on\" ; w:first x:cup ; w:second x:table ; "
          "w:because ?because }");
  ASSERT_EQ(why.results.rows.size(), 1u);
  const std::string text(kitchen.store.terms().text(why.results.rows[0][0]));
  EXPECT_NE(text.find("http://x/cup on http://x/table: true, along the axes of http://x/house"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("height-gap"), std::string::npos);
  // Stated anew, nothing is there twice, and without the viewer its relations are not there.
  const StatedFacts again = state_facts(relations, *kitchen.space, kitchen.store);
  EXPECT_EQ(again.left_out.size(), 3u);
  EXPECT_LT(again.facts, stated.facts);
  EXPECT_FALSE(ask("ASK { ?x w:left-of-as-seen ?y }").results.boolean.value());
  EXPECT_TRUE(ask("ASK { x:cup w:on x:table }").results.boolean.value());
}

INSTANTIATE_TEST_SUITE_P(ByDegrees, TurnedKitchen, testing::Values(0, 37, 90, 200, 315));

// A scene may say otherwise: with a rule of its own the same name means something else.
TEST(QualitativeModel, ARuleOfTheSceneTakesThePlaceOfTheUsualOne) {
  const std::string rule =
      "x:near-here a w:RelationRule ; w:called \"near\" ; w:axes \"space\" ; w:bodies 2 ;\n"
      "  w:condition [ w:measures \"distance\" ; w:maximum 50 ; qudt:unit unit:CentiM ] .\n";
  const model::Source source{"kitchen.ttl", model_text(0) + rule};
  graph::Store store;
  graph::Places places;
  Report report;
  model::load({&source, 1}, {}, store, places, report);
  World world;
  load_scene(world, store, places, report);
  const DeclaredScene scene = read_scene(world, store, places, report);
  report.throw_if_errors();
  Space space(world, world.find_frame("http://x/house"));
  add_bodies(space, scene);
  space.update(Stamp());
  const Relations relations = relations_of(space, scene);
  EXPECT_EQ(relations.rules().size(), usual_rules().size());
  const Judgement judgement = relations.judge({.relation = "near",
                                               .first = space.find("http://x/cup"),
                                               .second = space.find("http://x/bowl")});
  EXPECT_TRUE(judgement.holds) << explain(judgement);  // 0.41 m, and not within the usual 0.3 m
}

TEST(QualitativeModel, TooManyBodiesForAllPairsAreRefused) {
  World world;
  const FrameId root = world.add_frame("http://x/root");
  Space space(world, root);
  for (int i = 0; i < 1001; ++i) {
    space.add(world.add_object("http://x/o" + std::to_string(i), root), {{Sphere{0.1}, {}}});
  }
  space.update(Stamp());
  const Relations relations(space);
  graph::Store store;
  EXPECT_THROW(state_facts(relations, space, store), Error);
}

}  // namespace
}  // namespace sinew::world
