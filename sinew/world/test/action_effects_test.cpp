// Actions on the graph of a world: what they need, what they lead to, and what they would.
#include "sinew/world/action_effects.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "sinew/model/load.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/world/declared_actions.h"
#include "sinew/world/edit.h"
#include "sinew/world/situation_rules.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

const std::string kPrefixes = "PREFIX x: <http://x/> PREFIX w: <https://w3id.org/sinew/world#>\n";
const std::string kPick = "http://x/pick", kPlace = "http://x/place";
const std::string kPart = "http://x/part", kTable = "http://x/table";

// The gripper takes a part from where it lies: not empty afterwards, and the part is in it.
const ActionModel kPicking{
    .name = kPick,
    .parameters = {kPart},
    .preconditions = {{kPrefixes + "ASK { FILTER NOT EXISTS { x:gripper x:holds ?other } }",
                       "the gripper holds something"},
                      {kPrefixes + "ASK { w:this x:part ?part . ?part x:lies-on ?table }",
                       "the part lies nowhere"},
                      {kPrefixes +
                           "SELECT ?part ?mass ?payload WHERE { w:this x:part ?part . ?part x:mass "
                           "?mass . x:arm x:payload ?payload . FILTER(?mass > ?payload) }",
                       "{part} weighs {mass} kg, and the arm carries {payload} kg"}},
    .effect = kPrefixes +
              "DELETE { ?part x:lies-on ?table } INSERT { x:gripper x:holds ?part . "
              "?part x:is-in x:gripper } WHERE { w:this x:part ?part . ?part x:lies-on "
              "?table }"};
const ActionModel kPlacing{
    .name = kPlace,
    .parameters = {kTable},
    .preconditions = {{kPrefixes + "ASK { x:gripper x:holds ?part }", "the gripper is empty"}},
    .effect = kPrefixes +
              "DELETE { x:gripper x:holds ?part . ?part x:is-in x:gripper } INSERT { "
              "?part x:lies-on ?table } WHERE { x:gripper x:holds ?part . w:this "
              "x:table ?table }"};

struct Workshop {
  Workshop() {
    actions.add(kPicking);
    actions.add(kPlacing);
    graph::Transaction transaction = world.graph().begin();
    rdf::sparql::update(transaction, world.graph().terms(),
                        kPrefixes +
                            "INSERT DATA { x:bolt x:lies-on x:bench ; x:mass 0.2 . x:anvil "
                            "x:lies-on x:bench ; x:mass 40 . x:arm x:payload 2.5 }");
    transaction.commit();
    world.add_frame("http://x/frame");
  }
  ActionCall pick(const std::string& what, int second = 1) const {
    return {kPick, {{kPart, "http://x/" + what}}, "http://x/planner", at_s(second)};
  }
  ActionCall place(int second = 2) const {
    return {kPlace, {{kTable, "http://x/shelf"}}, "http://x/planner", at_s(second)};
  }
  bool ask(World& in, const std::string& pattern) const {
    return *rdf::sparql::query(in.graph().view(), in.graph().terms(),
                               kPrefixes + "ASK { " + pattern + " }")
                .results.boolean;
  }
  World world;
  Actions actions;
};

template <typename Call>
std::vector<Problem> problems(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.problems();
  }
  return {};
}

TEST(Actions, EffectsAreOnTheAgentAndOnTheObject) {
  Workshop shop;
  const ActionOutcome outcome = shop.actions.perform(shop.world, shop.pick("bolt"));
  EXPECT_TRUE(shop.ask(shop.world, "x:gripper x:holds x:bolt . x:bolt x:is-in x:gripper"));
  EXPECT_FALSE(shop.ask(shop.world, "x:bolt x:lies-on ?anything"));
  EXPECT_EQ(outcome.begun, (std::vector<FactText>{
                               {"<http://x/bolt>", "<http://x/is-in>", "<http://x/gripper>", ""},
                               {"<http://x/gripper>", "<http://x/holds>", "<http://x/bolt>", ""}}));
  EXPECT_EQ(
      outcome.ended,
      (std::vector<FactText>{{"<http://x/bolt>", "<http://x/lies-on>", "<http://x/bench>", ""}}));
  shop.actions.perform(shop.world, shop.place());
  EXPECT_TRUE(shop.ask(shop.world, "x:bolt x:lies-on x:shelf"));
  EXPECT_FALSE(shop.ask(shop.world, "x:gripper x:holds ?anything"));
  // Nothing of the arguments is left.
  EXPECT_FALSE(shop.ask(shop.world, "w:this ?p ?o"));
}

TEST(Actions, EveryPreconditionThatFailsIsNamedAndNothingChanges) {
  Workshop shop;
  shop.actions.perform(shop.world, shop.pick("bolt"));
  const auto before = facts_of(shop.world.graph().view());
  const auto found = problems([&] { shop.actions.perform(shop.world, shop.pick("anvil")); });
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].iri, kPick);
  EXPECT_EQ(found[0].what, "it cannot be performed: the gripper holds something");
  EXPECT_EQ(found[1].what,
            "it cannot be performed: http://x/anvil weighs 40 kg, and the arm carries 2.5 kg");
  EXPECT_FALSE(found[0].remedy.empty());
  EXPECT_EQ(facts_of(shop.world.graph().view()), before);
  EXPECT_EQ(shop.actions.reasons_against(shop.world, shop.pick("anvil")).size(), 2u);
  EXPECT_EQ(facts_of(shop.world.graph().view()), before);
  EXPECT_TRUE(shop.actions.reasons_against(shop.world, shop.place()).empty());
}

TEST(Actions, APredictionIsWhatPerformingLeadsTo) {
  Workshop shop;
  const auto before = facts_of(shop.world.graph().view());
  PredictedAction predicted = shop.actions.predict(shop.world, shop.pick("bolt"));
  EXPECT_TRUE(shop.ask(predicted.world, "x:gripper x:holds x:bolt"));
  EXPECT_FALSE(shop.ask(shop.world, "x:gripper x:holds x:bolt"));
  EXPECT_EQ(facts_of(shop.world.graph().view()), before);
  // What rules say of that future is known before it comes.
  SituationRules rules;
  rules.add({"http://x/fragile", kPrefixes + "SELECT ?part WHERE { x:gripper x:holds ?part }",
             "{part} is in the gripper"});
  EXPECT_EQ(rules.apply(predicted.world.graph()).findings.size(), 1u);
  EXPECT_EQ(rules.apply(shop.world.graph()).findings.size(), 0u);

  const ActionOutcome done = shop.actions.perform(shop.world, shop.pick("bolt"));
  EXPECT_EQ(done.begun, predicted.outcome.begun);
  EXPECT_EQ(done.ended, predicted.outcome.ended);
  // Two steps ahead: of a clone of a clone.
  const PredictedAction next = shop.actions.predict(predicted.world, shop.place());
  EXPECT_EQ(next.outcome.begun.size(), 1u);
  EXPECT_EQ(problems([&] { shop.actions.predict(shop.world, shop.pick("anvil")); }).size(), 2u);
}

TEST(Actions, BothAreAuditedWithTheReason) {
  Workshop shop;
  Rights rights;
  rights.allow("http://x/planner", Act::kPerform, kPick);
  const auto audit = std::make_shared<Audit>();
  const ActionSupervision supervision{.rights = &rights, .audit = audit};
  shop.actions.predict(shop.world, shop.pick("bolt"), supervision);
  shop.actions.perform(shop.world, shop.pick("bolt"), supervision);
  EXPECT_THROW(shop.actions.perform(shop.world, shop.pick("bolt"), supervision), Error);
  // No rule allows the planner to place, but it may ask what that would lead to.
  const auto refused =
      problems([&] { shop.actions.perform(shop.world, shop.place(), supervision); });
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_NE(refused[0].what.find("http://x/planner may not perform this action"),
            std::string::npos);
  shop.actions.predict(shop.world, shop.place(), supervision);
  const auto entries = audit->entries();
  ASSERT_EQ(entries.size(), 5u);
  const auto is = [&](std::size_t i, Act act, bool accepted, const std::string& what) {
    return entries[i].act == act && entries[i].accepted == accepted && entries[i].what == what &&
           entries[i].who == "http://x/planner";
  };
  EXPECT_TRUE(is(0, Act::kPredict, true, kPick));
  EXPECT_TRUE(is(1, Act::kPerform, true, kPick));
  EXPECT_TRUE(is(2, Act::kPerform, false, kPick));
  EXPECT_NE(entries[2].reason.find("the gripper holds something"), std::string::npos);
  EXPECT_TRUE(is(3, Act::kPerform, false, kPlace));
  EXPECT_TRUE(is(4, Act::kPredict, true, kPlace));
}

TEST(Actions, LeaveAHistoryOfWhatHeldWhen) {
  Workshop shop;
  FactHistory history;
  const ActionSupervision supervision{.history = &history};
  shop.actions.perform(shop.world, shop.pick("bolt", 10), supervision);
  World between = shop.world.clone();
  shop.actions.perform(shop.world, shop.place(20), supervision);
  graph::Terms& terms = shop.world.graph().terms();
  const auto held =
      history.intervals(terms.iri("http://x/gripper"), terms.iri("http://x/holds"), {});
  ASSERT_EQ(held.size(), 1u);
  EXPECT_EQ(held[0].begin, at_s(10));
  EXPECT_EQ(*held[0].end, at_s(20));
  graph::Store then = history.at(shop.world.graph(), at_s(15));
  const auto texts = [](graph::Store& store) {
    std::vector<std::string> all;
    for (const graph::Quad& fact : facts_of(store.view())) {
      all.push_back(store.terms().to_string(fact.subject) +
                    store.terms().to_string(fact.predicate) + store.terms().to_string(fact.object));
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(texts(then), texts(between.graph()));
}

TEST(Actions, WhatTheStructureSaysIsNotChangedByAnEffect) {
  Workshop shop;
  shop.actions.add({.name = "http://x/cheat",
                    .effect = "PREFIX x: <http://x/> DELETE { GRAPH ?g { x:frame ?p ?o } } WHERE { "
                              "GRAPH ?g { x:frame ?p ?o } }"});
  const auto before = facts_of(shop.world.graph().view());
  const auto found = problems([&] {
    shop.actions.perform(shop.world, {"http://x/cheat", {}, "me", at_s(1)});
  });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].what.find("changes what the world's structure says"), std::string::npos);
  EXPECT_EQ(facts_of(shop.world.graph().view()), before);
}

// Picking also attaches: what is in the gripper moves with it, in the prediction before and in the
// world afterwards; and if it cannot be attached, nothing has happened at all.
TEST(Actions, TheStructureFollowsTheAction) {
  Workshop shop;
  const FrameId table = shop.world.add_frame("http://x/table-frame"),
                tool = shop.world.add_frame("http://x/tool-frame"),
                bolt = shop.world.add_frame("http://x/bolt-frame");
  const auto measured = [&](const char* name, FrameId of) {
    const RelationId relation =
        shop.world.add_relation({.name = name, .of = of, .with_respect_to = table});
    return shop.world.add_measurement({.name = std::string(name) + "/value", .relation = relation});
  };
  const MeasurementId arm = measured("http://x/arm-pose", tool),
                      seen = measured("http://x/bolt-pose", bolt);
  shop.world.add_object("http://x/bolt", bolt);
  shop.world.write(arm, at_s(0), Pose{{}, {0, 0, 1}}, {"me"});
  ActionModel grasp = kPicking;
  grasp.name = "http://x/grasp";
  grasp.attach = kPrefixes +
                 "SELECT ?frame ?parent WHERE { w:this x:part ?part . ?part "
                 "w:attached-to ?frame . BIND(x:tool-frame AS ?parent) }";
  ActionModel release = kPlacing;
  release.name = "http://x/release";
  release.detach = kPrefixes +
                   "SELECT ?frame ?parent WHERE { x:gripper x:holds ?part . ?part "
                   "w:attached-to ?frame . BIND(x:table-frame AS ?parent) }";
  shop.actions.add(grasp);
  shop.actions.add(release);
  ActionCall call = shop.pick("bolt");
  call.action = grasp.name;

  // Nobody has seen the bolt: it cannot be attached, and the gripper does not hold it either.
  const auto before = facts_of(shop.world.graph().view());
  const std::uint64_t structure = shop.world.structure_version();
  EXPECT_EQ(problems([&] { shop.actions.perform(shop.world, call); }).size(), 1u);
  EXPECT_EQ(facts_of(shop.world.graph().view()), before);
  EXPECT_EQ(shop.world.structure_version(), structure);

  shop.world.write(seen, at_s(0), Pose{{}, {0.5, 0, 0}}, {"me"});
  PredictedAction predicted = shop.actions.predict(shop.world, call);
  EXPECT_EQ(predicted.outcome.attached,
            (std::vector<Attached>{{"http://x/bolt-frame", "http://x/tool-frame"}}));
  predicted.world.write(arm, at_s(1), Pose{{}, {0, 0, 3}}, {"me"});
  EXPECT_EQ(predicted.world.pose(bolt, table, at_s(1)).pose.p.z, 2);  // carried up
  EXPECT_EQ(shop.world.pose(bolt, table, at_s(1)).pose.p.z, 0);
  EXPECT_EQ(facts_of(shop.world.graph().view()), before);

  // The planner may perform it, but not change where the bolt hangs.
  Rights rights;
  rights.allow("http://x/planner", Act::kPerform, kAnything);
  EXPECT_EQ(problems([&] { shop.actions.perform(shop.world, call, {.rights = &rights}); }).size(),
            1u);
  EXPECT_EQ(facts_of(shop.world.graph().view()), before);
  rights.allow("http://x/planner", Act::kRelate, "http://x/bolt-frame");
  shop.actions.perform(shop.world, call, {.rights = &rights});
  shop.world.write(arm, at_s(1), Pose{{}, {0, 0, 3}}, {"me"});
  EXPECT_EQ(shop.world.pose(bolt, table, at_s(1)).pose.p.z, 2);
  EXPECT_TRUE(shop.ask(shop.world, "x:gripper x:holds x:bolt"));

  ActionCall put = shop.place();
  put.action = release.name;
  shop.actions.perform(shop.world, put);
  shop.world.write(arm, at_s(3), Pose{{}, {0, 0, 9}}, {"me"});
  EXPECT_EQ(shop.world.pose(bolt, table, at_s(3)).pose.p.z, 2);  // stays where it was let go
  EXPECT_TRUE(shop.ask(shop.world, "x:bolt x:lies-on x:shelf"));
}

// Actions and edits of other threads take turns, in whatever order they come.
TEST(Actions, TakeTurnsWithEdits) {
  Workshop shop;
  std::atomic<bool> stop = false;
  std::thread editing([&] {
    for (int i = 0; !stop; ++i) {
      const FrameId frame = shop.world.add_frame("http://x/passing" + std::to_string(i));
      shop.world.remove(frame);
    }
  });
  for (int i = 0; i < 200; ++i) {
    shop.actions.perform(shop.world, shop.pick("bolt", i));
    shop.actions.perform(shop.world, shop.place(i));
    ActionCall again = shop.pick("bolt", i);
    if (i % 10 == 0) shop.actions.predict(shop.world, again);
  }
  stop = true;
  editing.join();
  EXPECT_TRUE(shop.ask(shop.world, "x:bolt x:lies-on x:shelf"));
}

// ---- as models ----

struct FromModel {
  explicit FromModel(const std::string& turtle) {
    const std::string text =
        "@prefix w: <https://w3id.org/sinew/world#> . @prefix x: <http://x/> .\n" + turtle;
    const model::Source source{"actions.ttl", text};
    model::load({&source, 1}, {}, store, places, report);
    read_actions(store, places, actions, report);
  }
  graph::Store store;
  graph::Places places;
  Actions actions;
  Report report;
};

TEST(DeclaredActions, AModelIsTheActionThatItDescribes) {
  const FromModel declared(
      "x:open a w:Action ; w:parameter x:door ;\n"
      "  w:precondition [ w:query \"PREFIX x: <http://x/> PREFIX w: "
      "<https://w3id.org/sinew/world#> ASK { w:this x:door ?door . ?door x:is x:closed }\" ; "
      "w:message \"it is not closed\" ] ;\n"
      "  w:effect \"PREFIX x: <http://x/> PREFIX w: <https://w3id.org/sinew/world#> DELETE { ?door "
      "x:is x:closed } INSERT { ?door x:is x:open } WHERE { w:this x:door ?door }\" .\n");
  ASSERT_FALSE(declared.report.has_errors()) << to_string(declared.report.problems().front());
  ASSERT_EQ(declared.actions.size(), 1u);
  Workshop shop;
  const ActionCall open{"http://x/open", {{"http://x/door", "http://x/gate"}}, "me", at_s(1)};
  EXPECT_EQ(declared.actions.reasons_against(shop.world, open),
            (std::vector<std::string>{"it is not closed"}));
  graph::Store& store = shop.world.graph();
  const auto iri = [&](const char* name) { return store.terms().iri(name); };
  store.add({iri("http://x/gate"), iri("http://x/is"), iri("http://x/closed")});
  declared.actions.perform(shop.world, open);
  EXPECT_TRUE(shop.ask(shop.world, "x:gate x:is x:open"));
  EXPECT_FALSE(shop.ask(shop.world, "x:gate x:is x:closed"));
}

TEST(DeclaredActions, FaultsHaveAPlace) {
  const std::string effect = "w:effect \"INSERT DATA { <a:b> <a:b> <a:b> }\" ";
  const std::pair<std::string, std::string> cases[] = {
      {"x:a a w:Action .", "actions.ttl:2: http://x/a"},
      {"\nx:a a w:Action ; w:effect \"INSERT DATO {}\" .", "actions.ttl:3: http://x/a"},
      {"x:a a w:Action ; w:precondition [ w:query \"ASK {}\" ] ; " + effect + ".",
       "why not, when it fails"},
      {"x:a a w:Action ; w:attaches \"SELECT ?frame WHERE {}\" ; " + effect + ".",
       "does not select ?parent"}};
  for (const auto& [turtle, expected] : cases) {
    const FromModel declared(turtle);
    ASSERT_TRUE(declared.report.has_errors()) << turtle;
    EXPECT_NE(to_string(declared.report.problems().front()).find(expected), std::string::npos)
        << to_string(declared.report.problems().front());
    EXPECT_EQ(declared.actions.size(), 0u);
  }
}

TEST(Actions, WhatIsNoActionIsRefused) {
  Workshop shop;
  const auto refused = [&](ActionModel model) {
    return !problems([&] { shop.actions.add(std::move(model)); }).empty();
  };
  const std::string effect = "INSERT DATA { <http://x/a> <http://x/b> <http://x/c> }";
  EXPECT_TRUE(refused({.name = "", .effect = effect}));
  EXPECT_TRUE(refused({.name = kPick, .effect = effect}));
  EXPECT_TRUE(refused({.name = "http://x/a", .effect = "SELECT * WHERE { ?s ?p ?o }"}));
  EXPECT_TRUE(refused({.name = "http://x/a", .effect = "LOAD"}));
  EXPECT_TRUE(refused({.name = "http://x/a",
                       .preconditions = {{"CONSTRUCT WHERE { ?s ?p ?o }", "x"}},
                       .effect = effect}));
  EXPECT_TRUE(refused({.name = "http://x/a",
                       .preconditions = {{"SELECT ?s WHERE { ?s ?p ?o }", "{t}"}},
                       .effect = effect}));
  EXPECT_TRUE(refused(
      {.name = "http://x/a", .preconditions = {{"ASK { ?s ?p ?o }", ""}}, .effect = effect}));
  EXPECT_TRUE(refused(
      {.name = "http://x/a", .effect = effect, .attach = "SELECT ?frame WHERE { ?frame ?p ?o }"}));
  EXPECT_FALSE(refused({.name = "http://x/a", .effect = effect}));

  EXPECT_THROW(shop.actions.perform(shop.world, {"http://x/none", {}, "me", at_s(1)}), Error);
  EXPECT_THROW(shop.actions.perform(shop.world, {kPick, {}, "me", at_s(1)}), Error);
  ActionCall call = shop.pick("bolt");
  call.arguments["http://x/other"] = "http://x/y";
  EXPECT_THROW(shop.actions.perform(shop.world, call), Error);
}

// An effect of several operations whose last one fails leaves nothing of the first.
TEST(Actions, AnEffectIsWholeOrNothing) {
  Workshop shop;
  shop.actions.add({.name = "http://x/half",
                    .effect = "INSERT DATA { <http://x/a> <http://x/b> <http://x/c> } ; "
                              "LOAD <http://x/nowhere>"});
  const auto before = facts_of(shop.world.graph().view());
  EXPECT_THROW(shop.actions.perform(shop.world, {"http://x/half", {}, "me", at_s(1)}), Error);
  EXPECT_EQ(facts_of(shop.world.graph().view()), before);
}

}  // namespace
}  // namespace sinew::world
