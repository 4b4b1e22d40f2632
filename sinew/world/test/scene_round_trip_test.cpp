// A world that is written and read again is the same: its description, its numbers, its answers,
// and what is written of it the second time.
#include <gtest/gtest.h>

#include "every_kind.h"
#include "sinew/model/load.h"
#include "sinew/rdf/isomorphism/isomorphism.h"
#include "sinew/rdf/turtle/writer.h"
#include "sinew/world/copy_declarations.h"
#include "sinew/world/edit.h"
#include "sinew/world/fact_history.h"
#include "sinew/world/scene.h"

namespace sinew::world {
namespace {

struct Loaded {
  explicit Loaded(const std::string& turtle,
                  const SceneReading& reading = {.read_library = block_library}) {
    const model::Source source{"scene.ttl", turtle};
    model::load({&source, 1}, {}, store, places, report);
    load_scene(world, store, places, report, reading);
    if (!report.has_errors()) scene = read_scene(world, store, places, report);
  }
  graph::Store store;
  graph::Places places;
  Report report;
  World world;
  DeclaredScene scene;
};

struct Written {
  explicit Written(const World& world, const DeclaredScene& scene = {}) {
    write_scene(world, scene, store, report);
  }
  std::string text() const {
    return rdf::write_rdf(rdf::quads_of(store.view()), rdf::Syntax::kTurtle, store.terms());
  }
  graph::Store store;
  Report report;
};

// The world's own description, in words.
std::vector<std::string> description(World& world) {
  std::vector<std::string> lines;
  graph::Store& store = world.graph();
  for (const graph::Quad& fact : facts_of(store.view())) {
    lines.push_back(store.terms().to_string(fact.subject) + " " +
                    store.terms().to_string(fact.predicate) + " " +
                    store.terms().to_string(fact.object));
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

TEST(SceneRoundTrip, EverythingThatCanBeLoadedIsWritten) {
  Everything all;
  const Written first(all.world);
  ASSERT_TRUE(first.report.problems().empty()) << to_string(first.report.problems().front());
  Loaded loaded(first.text());
  ASSERT_FALSE(loaded.report.has_errors()) << to_string(loaded.report.problems().front()) << "\n"
                                           << first.text();
  EXPECT_EQ(description(loaded.world), description(all.world));

  // The same again, blank nodes apart.
  const Written second(loaded.world, loaded.scene);
  EXPECT_EQ(first.text(), second.text());
  Loaded again(second.text());
  EXPECT_EQ(description(again.world), description(all.world));

  // The same numbers, now and later, and the same placements of joints.
  const State state = all.world.state();
  for (Index at = 0; at < state.measurements.size(); ++at) {
    const MeasurementId here{at};
    const std::string& name = all.world.name(here);
    const MeasurementId there = loaded.world.find_measurement(name);
    ASSERT_TRUE(there) << name;
    for (const double time : {1.5, 2.5, 3.6}) {
      const World::Sample a = all.world.latest(here, at_s(time));
      const World::Sample b = loaded.world.latest(there, at_s(time));
      EXPECT_EQ(a.status, b.status) << name << " at " << time;
      EXPECT_EQ(a.values, b.values) << name << " at " << time;
      EXPECT_EQ(a.stamp, b.stamp) << name;
      EXPECT_EQ(a.freshness.expires, b.freshness.expires) << name;
    }
    EXPECT_EQ(all.world.model(here)->used_by, loaded.world.model(there)->used_by);
    EXPECT_EQ(state.measurements[at].cell->capacity(),
              loaded.world.state().measurements[there.index].cell->capacity());
  }
  for (const double time : {1.5, 2.5}) {
    const PoseAnswer a = all.world.pose(all.part, all.base, at_s(time));
    const PoseAnswer b = loaded.world.pose(loaded.world.find_frame("http://x/part"),
                                           loaded.world.find_frame("http://x/base"), at_s(time));
    ASSERT_EQ(a.status, Status::kOk);
    ASSERT_EQ(b.status, Status::kOk);
    EXPECT_EQ(a.pose.p.x, b.pose.p.x);
    EXPECT_EQ(a.pose.p.y, b.pose.p.y);
    EXPECT_EQ(a.pose.q.z, b.pose.q.z);
  }
  // Data blocks are consistent, and keep their order.
  const MeasurementId seen = loaded.world.find_measurement("http://x/seen");
  double block[7];
  const World::BlockBuffer buffer[] = {
      {loaded.world.find_block(seen, "http://x/seen/b"), block, sizeof block}};
  EXPECT_EQ(buffer[0].block, 0u);  // the real-time one comes first
  ASSERT_EQ(loaded.world.read_blocks(seen, buffer), Status::kOk);
  EXPECT_EQ(block[4] + block[5] + block[6], 24);
}

TEST(SceneRoundTrip, WhatAModelCannotSayIsAWarning) {
  World world;
  const FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b");
  const RelationId r = world.add_relation({.name = "http://x/r", .of = b, .with_respect_to = a});
  world.add_measurement({.name = "http://x/m",
                         .relation = r,
                         .model = {.life_cycle = Prediction{UserModel{
                                       "mine", [](const double*, double, double*) {}}}},
                         .blocks = {.library = block_library(kBlockLibrary),
                                    .canonical = {},
                                    .blocks = {{"http://x/block", kPosePrototype}},
                                    .library_text = {}}});
  const Written written(world);
  ASSERT_EQ(written.report.problems().size(), 2u);
  EXPECT_FALSE(written.report.has_errors());
}

TEST(SceneRoundTrip, FaultsOfJointsNumbersAndBlocksHaveAPlace) {
  Everything all;
  const std::string good = Written(all.world).text();
  struct Case {
    std::string from, to, expected;
  };
  const Case cases[] = {{"\"SI\"", "\"CGS\"", "no system of units 'CGS'"},
                        {"\"joint-velocity\"", "\"haste\"", "no quantity 'haste'"},
                        {"\"sinew_world_pose\"", "\"no_pose\"", "no_pose"}};
  for (const Case& one : cases) {
    std::string text = good;
    for (std::size_t at = text.find(one.from); at != std::string::npos;
         at = text.find(one.from, at + one.to.size())) {
      text.replace(at, one.from.size(), one.to);
    }
    ASSERT_NE(text, good) << one.from;
    const Loaded loaded(text);
    ASSERT_TRUE(loaded.report.has_errors()) << one.from;
    bool found = false;
    for (const Problem& problem : loaded.report.problems()) {
      found = found || (to_string(problem).find(one.expected) != std::string::npos &&
                        to_string(problem).starts_with("scene.ttl:"));
    }
    EXPECT_TRUE(found) << to_string(loaded.report.problems().front());
    EXPECT_EQ(loaded.world.state().frames.size(), 0u);
  }
  EXPECT_TRUE(Loaded(good, {}).report.has_errors());  // nobody reads the library
}

TEST(SceneRoundTrip, RightsAndActionsAreTakenOver) {
  const model::Source source{
      "rights.ttl",
      "@prefix w: <https://w3id.org/sinew/world#> . @prefix x: <http://x/> .\n"
      "x:camera a w:Component ; w:writes x:seen .\n"
      "[] a w:Allowance ; w:who x:camera ; w:act \"read-graph\" ; w:what x:notes .\n"
      "x:open a w:Action ; w:effect \"INSERT DATA { <x:a> <x:b> <x:c> }\" ;\n"
      "  w:precondition [ w:query \"ASK {}\" ; w:message \"never\" ] . x:other x:p x:q .\n"};
  graph::Store from, to;
  graph::Places places;
  Report report;
  model::load({&source, 1}, {}, from, places, report);
  EXPECT_EQ(copy_declarations(from, to), 11u);
  EXPECT_FALSE(to.view().contains(to.terms().iri("http://x/other"), {}, {}));
}

}  // namespace
}  // namespace sinew::world
