// Who may not read where something is does not learn it from what follows of it: facts, SPARQL,
// what rules derive, triggers, explanations, regions, predictions, the past; refusals are in the
// audit.
#include <gtest/gtest.h>

#include "sinew/rdf/sparql/engine.h"
#include "sinew/world/edit.h"
#include "sinew/world/participant.h"
#include "sinew/world/qualitative_facts.h"
#include "sinew/world/situation_rules.h"
#include "sinew/world/space.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

const std::string kTask = "http://x/task", kCamera = "http://x/camera", kOther = "http://x/other";
const std::string kSeen = "http://x/seen";

std::vector<Shape> box(double x, double y, double z) { return {{Box{{x, y, z}}, {}}}; }

// A cup that a camera sees on the table, for the task alone; a lamp that stands there for
// everybody.
struct Table {
  Table() {
    world.add_static("http://x/standing", table, room, {{}, {0, 0, 0.5}}, "http://x/me");
    const RelationId lying =
        world.add_relation({.name = "http://x/lying", .of = cup, .with_respect_to = table});
    seen = world.add_measurement(
        {.name = kSeen, .relation = lying, .model = {.provenance = kCamera, .used_by = {kTask}}});
    world.add_static("http://x/lit", lamp, table, {{}, {-0.3, 0, 0.15}}, "http://x/me");
    world.add_object("http://x/the-table", table);
    world.add_object("http://x/the-cup", cup);
    world.add_object("http://x/the-lamp", lamp);
    move(1, {0.3, 0, 0.06});
  }
  void move(int second, const Vector3& position) {
    world.write(seen, at_s(second), Pose{{}, position}, {kCamera});
  }
  template <typename Whose>
  Space space_of(const Whose& whose, Stamp now) const {
    Space space(whose, room);
    space.add(world.find_object("http://x/the-table"), box(1, 1, 0.02));
    space.add(world.find_object("http://x/the-cup"), box(0.1, 0.1, 0.1));
    space.add(world.find_object("http://x/the-lamp"), box(0.1, 0.1, 0.28));
    space.add_area("http://x/area", room, {{Box{{2, 2, 2}}, {}}});
    space.update(now);
    return space;
  }
  // What the owner knows, written into the world's graph for all.
  void state(int second) {
    const Space space = space_of(world, at_s(second));
    state_facts(Relations(space), space, world.graph());
    SituationRules rules;
    rules.add({.name = "http://x/graspable",
               .query = "PREFIX x: <http://x/> PREFIX w: <https://w3id.org/sinew/world#> CONSTRUCT "
                        "{ ?o x:affords x:grasping } WHERE { GRAPH ?g { ?o w:on x:the-table } }"});
    rules.apply(world.graph());
  }
  World world;
  FrameId room = world.add_frame("http://x/room");
  FrameId table = world.add_frame("http://x/table"), cup = world.add_frame("http://x/cup");
  FrameId lamp = world.add_frame("http://x/lamp");
  MeasurementId seen;
  std::shared_ptr<Audit> audit = std::make_shared<Audit>();
};

bool ask(graph::Store& store, const std::string& pattern) {
  return *rdf::sparql::query(store.view(), store.terms(),
                             "PREFIX x: <http://x/> PREFIX w: <https://w3id.org/sinew/world#> ASK "
                             "{ GRAPH ?g { " +
                                 pattern + " } }")
              .results.boolean;
}
bool ask(graph::Store&& store, const std::string& pattern) { return ask(store, pattern); }
bool names(const std::vector<std::string>& all, std::string_view name) {
  return std::find(all.begin(), all.end(), name) != all.end();
}

const char* const kOnTheTable = "x:the-cup w:on x:the-table";
const char* const kBecause = "?f w:first x:the-cup ; w:because ?why";
const char* const kLampOnTheTable = "x:the-lamp w:on x:the-table";
const char* const kGraspable = "x:the-cup x:affords x:grasping";

TEST(DerivedFacts, AreReadByWhoMayReadAllThatTheyComeFrom) {
  Table t;
  t.state(1);
  Access access(t.world, {}, t.audit);
  JudgedFacts task = access.participant(kTask).read().facts();
  for (const char* fact : {kOnTheTable, kBecause, kLampOnTheTable, kGraspable}) {
    EXPECT_TRUE(ask(task.store, fact)) << fact;
  }
  EXPECT_TRUE(ask(task.store, "?f w:first x:the-cup ; w:derived-from x:seen"));
  EXPECT_TRUE(task.left_out.empty());

  const std::uint64_t refused = t.audit->counts().refused;
  JudgedFacts other = access.participant(kOther).read().facts();
  EXPECT_FALSE(ask(other.store, kOnTheTable));
  EXPECT_FALSE(ask(other.store, "x:the-cup ?relation x:the-lamp"));
  EXPECT_FALSE(ask(other.store, "x:the-lamp ?relation x:the-cup"));
  EXPECT_FALSE(ask(other.store, "?f w:first x:the-cup"));
  EXPECT_FALSE(ask(other.store, "?f w:second x:the-cup"));
  EXPECT_FALSE(ask(other.store, "?f w:because ?why FILTER(CONTAINS(?why, \"cup\"))"));
  EXPECT_TRUE(ask(other.store, kLampOnTheTable)) << "what comes from what everybody reads";
  EXPECT_TRUE(names(other.left_out, kSeen));
  EXPECT_GT(t.audit->counts().refused, refused);
  const AuditEntry last = [&] {
    AuditEntry found;
    for (const AuditEntry& entry : t.audit->entries()) {
      if (!entry.accepted) found = entry;
    }
    return found;
  }();
  EXPECT_EQ(last.act, Act::kRead);
  EXPECT_EQ(last.who, kOther);
  EXPECT_EQ(last.what, kSeen);
}

// Whatever a rule looked at: its facts are left out together, named, and made of the copy.
TEST(DerivedFacts, WhatRulesDeriveFromThemIsLeftOutAndDerivedAnewFromWhatIsRead) {
  Table t;
  t.state(1);
  Access access(t.world, {}, t.audit);
  JudgedFacts other = access.participant(kOther).read().facts();
  EXPECT_FALSE(ask(other.store, kGraspable));
  EXPECT_TRUE(names(other.left_out, kDerivedGraph));
  SituationRules rules;
  rules.add({.name = "http://x/graspable",
             .query = "PREFIX x: <http://x/> PREFIX w: <https://w3id.org/sinew/world#> CONSTRUCT { "
                      "?o x:affords x:grasping } WHERE { GRAPH ?g { ?o w:on x:the-table } }"});
  rules.apply(other.store);
  EXPECT_TRUE(ask(other.store, "x:the-lamp x:affords x:grasping"));
  EXPECT_FALSE(ask(other.store, kGraspable));
}

TEST(DerivedFacts, OfAMeasurementThatWasRemovedAreNobodys) {
  Table t;
  t.state(1);
  Access access(t.world, {}, t.audit);
  Edit edit = t.world.edit();
  edit.remove(t.seen);
  edit.commit();
  JudgedFacts task = access.participant(kTask).read().facts();
  EXPECT_FALSE(ask(task.store, kOnTheTable));
  EXPECT_TRUE(ask(task.store, kLampOnTheTable));
}

TEST(DerivedFacts, AreNotInThePastEither) {
  Table t;
  FactHistory history;
  t.state(1);
  history.observe(t.world.graph(), at_s(1));
  t.move(2, {3, 0, 0.06});
  t.state(2);
  history.observe(t.world.graph(), at_s(2));
  Access access(t.world, {}, t.audit);
  const Participant task = access.participant(kTask), other = access.participant(kOther);
  EXPECT_TRUE(ask(task.read().facts_at(history, at_s(1)).store, kOnTheTable));
  EXPECT_FALSE(ask(task.read().facts_at(history, at_s(2)).store, kOnTheTable));
  EXPECT_FALSE(ask(other.read().facts_at(history, at_s(1)).store, kOnTheTable));
  EXPECT_TRUE(ask(other.read().facts_at(history, at_s(1)).store, kLampOnTheTable));
}

// A condition reads as its listener: one of the other's never comes to hold, whatever happens.
TEST(DerivedFacts, TriggerNobodyWhoMayNotReadThem) {
  Table t;
  Access access(t.world, {}, t.audit);
  Triggers triggers(t.world);
  const auto queue = std::make_shared<EventQueue>();
  int task = 0, other = 0, lamp = 0;
  const auto listen = [&](const std::string& who, const char* pattern, int& count) {
    access.participant(who).read().listen(
        triggers,
        {.when = JudgedCondition{[pattern](const Reader& reader, Stamp) {
           return ask(reader.facts().store, pattern);
         }},
         .callback = [&count](const Event&) { ++count; }},
        queue);
  };
  listen(kTask, kOnTheTable, task);
  listen(kOther, kOnTheTable, other);
  listen(kOther, kLampOnTheTable, lamp);
  triggers.look(at_s(1));
  t.state(1);
  triggers.look(at_s(2));
  queue->run();
  EXPECT_EQ(task, 1);
  EXPECT_EQ(other, 0);
  EXPECT_EQ(lamp, 1);
}

TEST(DerivedFacts, ExplanationsAndRegionsHaveNoPlaceForThem) {
  Table t;
  Access access(t.world, {}, t.audit);
  const Participant task = access.participant(kTask), other = access.participant(kOther);
  const Space of_task = t.space_of(task.read(), at_s(1)),
              of_other = t.space_of(other.read(), at_s(1));
  const auto judged = [](const Space& space) {
    return Relations(space).judge({.relation = "on",
                                   .first = space.find("http://x/the-cup"),
                                   .second = space.find("http://x/the-table")});
  };
  EXPECT_TRUE(judged(of_task).holds);
  EXPECT_EQ(judged(of_other).status, Status::kForbidden);
  EXPECT_EQ(explain(judged(of_other)), "http://x/the-cup on http://x/the-table: not known, " +
                                           std::string(to_string(Status::kForbidden)));
  EXPECT_TRUE(judged(of_other).findings.empty());
  const auto found =
      Relations(of_other).find({.relation = "near", .second = of_other.find("http://x/the-table")});
  EXPECT_EQ(found.unplaced, std::vector{of_other.find("http://x/the-cup")});
  EXPECT_EQ(of_task.within("http://x/area", Match::kTouching).bodies.size(), 3u);
  const RegionAnswer by_name = of_other.within("http://x/area", Match::kTouching);
  EXPECT_EQ(by_name.bodies.size(), 2u);
  EXPECT_EQ(by_name.unplaced, std::vector{of_other.find("http://x/the-cup")});
  const RegionAnswer by_volume = of_other.within(t.room, {{Box{{2, 2, 2}}, {}}}, Match::kInside);
  EXPECT_EQ(by_volume.bodies.size(), 2u);
  // Facts that he states himself are of what he may read.
  graph::Store own;
  const StatedFacts stated = state_facts(Relations(of_other), of_other, own);
  EXPECT_EQ(stated.unplaced, std::vector{of_other.find("http://x/the-cup")});
  EXPECT_FALSE(ask(own, kOnTheTable));
  EXPECT_TRUE(ask(own, kLampOnTheTable));
  EXPECT_TRUE(ask(own, "?f w:derived-from <http://x/standing/value>"));
}

// Nothing was written in between: that nothing moved is not told either.
TEST(DerivedFacts, ARegionFollowsTheRightsAtTheNextUpdate) {
  Table t;
  Access access(t.world, {}, t.audit);
  const Participant task = access.participant(kTask);
  Space space = t.space_of(task.read(), at_s(1));
  const BodyId cup = space.find("http://x/the-cup");
  const auto has_cup = [&] {
    return space.within(t.room, {{Box{{2, 2, 2}}, {}}}, Match::kTouching).bodies.size() == 3u;
  };
  EXPECT_TRUE(has_cup());
  Rights less;
  less.forbid(kTask, Act::kRead, kSeen);
  access.change(less);
  space.update(at_s(1));
  EXPECT_FALSE(has_cup());
  EXPECT_EQ(space.status(cup), Status::kForbidden);
  access.change({});
  space.update(at_s(1));
  EXPECT_TRUE(has_cup());
}

// Whether it would be refused tells what it looked at.
TEST(DerivedFacts, PredictionsDoNotLookAtThem) {
  Table t;
  t.state(1);
  Actions actions;
  actions.add({.name = "http://x/note",
               .preconditions = {{"PREFIX x: <http://x/> PREFIX w: <https://w3id.org/sinew/world#> "
                                  "ASK { GRAPH ?g { x:the-cup w:on x:the-table } }",
                                  "the cup is elsewhere"}},
               .effect = "PREFIX x: <http://x/> INSERT DATA { x:cup x:noted true }"});
  actions.add({.name = "http://x/copy",
               .effect = "PREFIX x: <http://x/> PREFIX w: <https://w3id.org/sinew/world#> INSERT { "
                         "?a x:lies-on ?b } WHERE { GRAPH ?g { ?a w:on ?b } }"});
  Access access(t.world, {}, t.audit);
  const Participant task = access.participant(kTask), other = access.participant(kOther);
  EXPECT_NO_THROW(task.predict(actions, "http://x/note", {}, at_s(1)));
  EXPECT_THROW(other.predict(actions, "http://x/note", {}, at_s(1)), Error);
  const auto begun = [&](const Participant& who) {
    std::size_t of_cup = 0;
    for (const FactText& fact : who.predict(actions, "http://x/copy", {}, at_s(1)).outcome.begun) {
      of_cup += fact.subject == "<http://x/the-cup>";
    }
    return of_cup;
  };
  EXPECT_EQ(begun(task), 1u);
  EXPECT_EQ(begun(other), 0u);
  EXPECT_TRUE(ask(t.world.graph(), kOnTheTable)) << "the world itself is as it was";
}

}  // namespace
}  // namespace sinew::world
