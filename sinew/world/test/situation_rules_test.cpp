// Rules about a situation: payload against capability, and what an object affords by its context,
// as the world's structure changes.
#include "sinew/world/situation_rules.h"

#include <gtest/gtest.h>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/model/load.h"
#include "sinew/world/edit.h"
#include "sinew/world/world.h"

namespace sinew::world {
namespace {

const std::string kPrefixes =
    "PREFIX x: <http://x/> PREFIX w: <https://w3id.org/sinew/world#>\n"
    "PREFIX rel: <https://comp-rob2b.github.io/metamodels/geometry/spatial-relations#>\n";

// What hangs on the tool, as the world has it now.
const std::string kHolds =
    "?relation rel:of ?frame ; rel:with-respect-to x:tool .\n"
    "FILTER NOT EXISTS { ?relation w:suspended true }\n"
    "?part w:attached-to ?frame ; w:instance-of ?model .\n";

const SituationRule kPayload{"http://x/payload",
                             kPrefixes + "SELECT ?part ?mass ?capacity WHERE {\n" + kHolds +
                                 "?model x:mass ?m . ?m x:number ?mass ; x:unit ?unit .\n"
                                 "x:arm x:payload ?c . ?c x:number ?capacity ; x:unit ?unit .\n"
                                 "FILTER(?mass > ?capacity) }",
                             "{part} weighs {mass} kg, and the arm carries {capacity} kg"};

// What is on the table and light can be grasped, unless something is in the gripper.
const SituationRule kGrasp{"http://x/grasp",
                           kPrefixes +
                               "CONSTRUCT { ?part x:affords x:grasping } WHERE {\n"
                               "?part w:attached-to ?frame ; w:instance-of ?model .\n"
                               "?relation rel:of ?frame ; rel:with-respect-to x:table .\n"
                               "FILTER NOT EXISTS { ?relation w:suspended true }\n"
                               "FILTER NOT EXISTS { ?held rel:with-respect-to x:tool .\n"
                               "  FILTER NOT EXISTS { ?held w:suspended true } } }"};

// A fact that follows from a fact.
const SituationRule kTask{
    "http://x/task",
    kPrefixes + "CONSTRUCT { ?part x:affords x:assembling } WHERE { ?part x:affords x:grasping }"};

const SituationRule kAffordances{
    "http://x/affordances",
    kPrefixes + "SELECT ?part ?what WHERE { ?part x:affords ?what } ORDER BY ?part ?what",
    "{part} affords {what}"};

struct Table {
  Table() {
    table = world.add_frame("http://x/table");
    tool = world.add_frame("http://x/tool");
    world.add_static("http://x/arm-on-table", tool, table, {{}, {0, 0, 1}}, "http://x/me");
    for (const std::string name : {"bolt", "anvil"}) {
      const FrameId frame = world.add_frame("http://x/frame-of-" + name);
      const RelationId relation = world.add_relation(
          {.name = "http://x/place-of-" + name, .of = frame, .with_respect_to = table});
      const MeasurementId seen =
          world.add_measurement({.name = "http://x/seen-" + name, .relation = relation});
      world.write(seen, Stamp(), Pose{}, {"http://x/camera"});
      world.add_object("http://x/" + name, frame, "http://x/" + name + "-model");
    }
    const std::string models =
        "@prefix x: <http://x/> .\n"
        "x:bolt-model x:mass [ x:number 0.2 ; x:unit x:kg ] .\n"
        "x:anvil-model x:mass [ x:number 40.0 ; x:unit x:kg ] .\n"
        "x:arm x:payload [ x:number 2.5 ; x:unit x:kg ] .\n";
    graph::Places places;
    Report report;
    const model::Source source{"models.ttl", models};
    model::load({&source, 1}, {}, world.graph(), places, report);
    report.throw_if_errors();
  }
  FrameId frame_of(const std::string& name) {
    return world.find_frame("http://x/frame-of-" + name);
  }
  World world;
  FrameId table, tool;
};

std::vector<std::string> messages(const AppliedRules& situation) {
  std::vector<std::string> result;
  for (const Finding& finding : situation.findings) result.push_back(finding.message);
  return result;
}

using Messages = std::vector<std::string>;

TEST(SituationRules, WhatIsTooHeavyForTheArmIsFoundWhenItHangsOnIt) {
  Table t;
  SituationRules rules;
  rules.add(kPayload);
  EXPECT_TRUE(rules.apply(t.world.graph()).findings.empty());
  t.world.attach(t.frame_of("bolt"), t.tool, Stamp(), "http://x/me");
  EXPECT_TRUE(rules.apply(t.world.graph()).findings.empty());
  t.world.attach(t.frame_of("anvil"), t.tool, Stamp(), "http://x/me");
  const AppliedRules situation = rules.apply(t.world.graph());
  ASSERT_EQ(situation.findings.size(), 1u);
  EXPECT_EQ(situation.findings[0].rule, "http://x/payload");
  EXPECT_EQ(situation.findings[0].message,
            "http://x/anvil weighs 40.0 kg, and the arm carries 2.5 kg");
  EXPECT_EQ(situation.findings[0].values.at("part"), "http://x/anvil");
  t.world.detach(t.frame_of("anvil"), t.table, Stamp(), "http://x/me");
  EXPECT_TRUE(rules.apply(t.world.graph()).findings.empty());
}

TEST(SituationRules, AffordancesFollowTheContextAndGoWithIt) {
  Table t;
  SituationRules rules;
  rules.add(kTask);  // before the rule whose facts it needs: the order does not matter
  rules.add(kGrasp);
  rules.add(kAffordances);
  const Messages all = {
      "http://x/anvil affords http://x/assembling", "http://x/anvil affords http://x/grasping",
      "http://x/bolt affords http://x/assembling", "http://x/bolt affords http://x/grasping"};
  AppliedRules situation = rules.apply(t.world.graph());
  EXPECT_EQ(messages(situation), all);
  EXPECT_EQ(situation.facts, 4u);
  EXPECT_LE(situation.rounds, 3);
  situation = rules.apply(t.world.graph());  // they do not hold themselves up, nor pile up
  EXPECT_EQ(messages(situation), all);

  t.world.attach(t.frame_of("bolt"), t.tool, Stamp(), "http://x/me");  // the gripper is full
  situation = rules.apply(t.world.graph());
  EXPECT_TRUE(situation.findings.empty());
  EXPECT_EQ(situation.facts, 0u);
  t.world.detach(t.frame_of("bolt"), t.table, Stamp(), "http://x/me");
  EXPECT_EQ(messages(rules.apply(t.world.graph())), all);
}

TEST(SituationRules, WhatNeverEndsIsRefusedAndChangesNothing) {
  Table t;
  SituationRules good, endless;
  good.add(kGrasp);
  ASSERT_EQ(good.apply(t.world.graph()).facts, 2u);
  endless.add({"http://x/endless", kPrefixes +
                                       "CONSTRUCT { [] x:after ?x } WHERE { ?x x:payload ?c "
                                       "} "});
  try {
    endless.apply(t.world.graph());
    FAIL() << "it ended";
  } catch (const Error& error) {
    EXPECT_EQ(error.problems().front().iri, "http://x/endless");
  }
  graph::Store& store = t.world.graph();
  const graph::Id affords = store.terms().iri("http://x/affords");
  const graph::Id grasping = store.terms().iri("http://x/grasping");
  EXPECT_TRUE(store.view().contains(store.terms().iri("http://x/bolt"), affords, grasping));
  EXPECT_FALSE(
      store.view().subject(store.terms().iri("http://x/after"), store.terms().iri("http://x/arm")));
}

TEST(SituationRules, RefusesWhatIsNoRule) {
  SituationRules rules;
  const auto fault = [&](SituationRule rule) {
    try {
      rules.add(std::move(rule));
    } catch (const Error& error) {
      return to_string(error.problems().front());
    }
    return std::string("none");
  };
  EXPECT_NE(fault({"http://x/r", "SELECT ?x WHERE { ?x"}).find("http://x/r"), std::string::npos);
  EXPECT_NE(fault({"http://x/r", "ASK { ?s ?p ?o }"}).find("ASK"), std::string::npos);
  EXPECT_NE(fault({"http://x/r", "SELECT ?x WHERE { ?x ?p ?o }", "{y} is wrong"}).find("{y}"),
            std::string::npos);
  EXPECT_NE(fault({"http://x/r", "SELECT ?x WHERE { ?x ?p ?o }", "{x is wrong"}), "none");
  EXPECT_NE(fault({"http://x/r", "CONSTRUCT WHERE { ?x ?p ?o }", "facts"}), "none");
  EXPECT_EQ(fault({"http://x/r", "SELECT ?x WHERE { ?x ?p ?o }", "{x} is wrong"}), "none");
}

}  // namespace
}  // namespace sinew::world
