// Every way by which a component reaches data, and what the rights say of it: refused by each where
// it is no user, recorded, and taken back when the rights change.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "allocations.h"
#include "seen_part.h"
#include "sinew/graph/property_graph.h"
#include "sinew/model/load.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/world/participant.h"
#include "sinew/world/space.h"

namespace sinew::world {
namespace {

const std::string kNotes = "http://x/notes";

// With a bolt on the part, and something said of both in the world's graph.
struct Cell : SeenPart {
  Cell() : SeenPart({kTask}) {
    bolt = world.add_object("http://x/bolt", part);
    graph::Terms& terms = world.graph().terms();
    world.graph().add({terms.iri("http://x/bolt"), terms.iri("http://x/price"),
                       terms.literal("high"), terms.iri(kNotes)});
    world.graph().add({terms.iri(kSeen), terms.iri("http://x/quality"), terms.literal("poor"), {}});
  }
  ObjectId bolt;
  std::shared_ptr<Audit> audit = std::make_shared<Audit>();
};

Rights rights_of_the_cell() {
  Rights rights;
  rights.allow(kTask, Act::kReadGraph, kNotes);
  rights.allow(kTask, Act::kRelate, "http://x/part");
  return rights;
}

bool is_refused(const std::function<void()>& call, const std::string& iri = kSeen) {
  try {
    call();
  } catch (const Error& error) {
    return error.problems().front().iri == iri;
  }
  return false;
}

bool ask(graph::Store& store, const std::string& pattern) {
  return *rdf::sparql::query(store.view(), store.terms(),
                             "PREFIX x: <http://x/> PREFIX w: <https://w3id.org/sinew/world#> ASK "
                             "{ { " +
                                 pattern + " } UNION { GRAPH ?g { " + pattern + " } } }")
              .results.boolean;
}

TEST(Access, EveryWayToAMeasurementIsRefusedToWhoIsNoUserAndRecorded) {
  Cell cell;
  Access access(cell.world, rights_of_the_cell(), cell.audit);
  const Participant task = access.participant(kTask), other = access.participant(kOther);
  Triggers triggers(cell.world);
  const auto queue = std::make_shared<EventQueue>();
  Uncertainties known;
  known.set_exact(cell.seen);
  known.set_exact(cell.world.find_measurement("http://x/standing/value"));
  double pose[7];
  const World::BlockBuffer none[] = {{0, pose, sizeof pose}};
  struct Way {
    const char* name;
    std::function<void(const Reader&)> read;
  };
  const Way ways[] = {
      {"a pose", [&](const Reader& by) { by.pose(cell.part, cell.base, at_s(1)); }},
      {"a prepared pose", [&](const Reader& by) { by.prepare_pose(cell.query()); }},
      {"a prepared motion", [&](const Reader& by) { by.prepare_motion(cell.query()); }},
      {"the last value", [&](const Reader& by) { by.latest(cell.seen, at_s(1)); }},
      {"a past value", [&](const Reader& by) { by.at(cell.seen, at_s(1)); }},
      {"the history", [&](const Reader& by) { by.history(cell.seen); }},
      {"the model", [&](const Reader& by) { by.model(cell.seen); }},
      {"a distribution",
       [&](const Reader& by) { by.pose_distribution(cell.query(), known, at_s(1)); }},
      {"a past distribution",
       [&](const Reader& by) { by.pose_distribution_at(cell.query(), known, at_s(1)); }},
      {"an uncertain pose",
       [&](const Reader& by) { by.uncertain_pose(cell.query(), known, at_s(1)); }},
      {"a program",
       [&](const Reader& by) {
         graph::Store store;
         by.pose_program(cell.query(), store, "program");
       }},
      {"a trigger",
       [&](const Reader& by) {
         by.listen(triggers, {.when = OnChange{cell.seen}, .callback = [](const Event&) {}}, queue);
       }},
  };
  for (const Way& way : ways) {
    EXPECT_NO_THROW(way.read(task.read())) << way.name;
    const std::uint64_t refused = cell.audit->counts().refused;
    EXPECT_TRUE(is_refused([&] { way.read(other.read()); })) << way.name;
    const auto entries = cell.audit->entries();
    EXPECT_EQ(cell.audit->counts().refused, refused + 1) << way.name;
    EXPECT_EQ(entries.back().what, kSeen) << way.name;
    EXPECT_EQ(entries.back().who, kOther) << way.name;
    EXPECT_EQ(entries.back().act, Act::kRead) << way.name;
    EXPECT_FALSE(entries.back().accepted) << way.name;
  }
  // Blocks: the measurement has none, but the rights come first.
  EXPECT_TRUE(is_refused([&] { other.read().read_blocks(cell.seen, none); }));
  EXPECT_TRUE(is_refused([&] { other.read().read_blocks_at(cell.seen, at_s(1), none); }));
  // The same of a clone.
  const Participant clone = other.clone();
  EXPECT_TRUE(is_refused([&] { clone.read().pose(cell.part, cell.base, at_s(1)); }));
  EXPECT_EQ(task.clone().read().pose(cell.part, cell.base, at_s(1)).pose.p.x, 1);
}

TEST(Access, WritingIsAsOneselfAndJudged) {
  Cell cell;
  Access access(cell.world, rights_of_the_cell(), cell.audit);
  Participant camera = access.participant(kCamera), other = access.participant(kOther);
  EXPECT_EQ(camera.write(cell.seen, at_s(2), Pose{}), Status::kOk);
  EXPECT_TRUE(is_refused([&] { other.write(cell.seen, at_s(3), Pose{}); }));
  EXPECT_TRUE(is_refused([&] { other.claim(cell.seen); }));
  EXPECT_TRUE(
      is_refused([&] { other.change().attach(cell.part, cell.base, at_s(3)); }, "http://x/part"));
  EXPECT_NO_THROW(access.participant(kTask).change().attach(cell.part, cell.base, at_s(3)));
  // Also of a measurement that is younger than the rights, with its name in the audit.
  const MeasurementId young = cell.world.add_measurement(
      {.name = "http://x/young", .relation = cell.lying, .model = {.provenance = kCamera}});
  EXPECT_TRUE(is_refused([&] { other.write(young, at_s(3), Pose{}); }, "http://x/young"));
  EXPECT_EQ(cell.audit->entries().back().what, "http://x/young");
}

TEST(Access, AGraphIsWithoutWhatOneMayNotRead) {
  Cell cell;
  Access access(cell.world, rights_of_the_cell(), cell.audit);
  JudgedFacts all = access.participant(kTask).read().facts();
  EXPECT_TRUE(all.left_out.empty());
  EXPECT_TRUE(ask(all.store, "x:lying w:measured-by x:seen"));
  EXPECT_TRUE(ask(all.store, "x:bolt x:price ?price"));
  EXPECT_TRUE(ask(all.store, "x:seen x:quality ?quality"));

  JudgedFacts some = access.participant(kOther).read().facts();
  EXPECT_EQ(some.left_out, (std::vector<std::string>{kNotes, kSeen}));
  EXPECT_FALSE(ask(some.store, "x:lying w:measured-by x:seen"));
  EXPECT_FALSE(ask(some.store, "x:seen ?any ?thing"));
  EXPECT_FALSE(ask(some.store, "<http://x/seen/data> ?any ?thing"));
  EXPECT_FALSE(ask(some.store, "x:bolt x:price ?price"));
  EXPECT_TRUE(ask(some.store, "x:bolt w:attached-to x:part"));
  const auto entries = cell.audit->entries();
  EXPECT_TRUE(std::any_of(entries.begin(), entries.end(), [](const AuditEntry& entry) {
    return entry.act == Act::kReadGraph && !entry.accepted && entry.what == kNotes &&
           entry.who == kOther;
  }));
  // As a property graph, too; what is changed in it is changed nowhere else.
  graph::Transaction transaction = some.store.begin();
  graph::PropertyGraph properties(transaction, some.store.terms());
  EXPECT_TRUE(properties.properties(some.store.terms().iri(kSeen)).empty());
  properties.set(some.store.terms().iri("http://x/bolt"), some.store.terms().iri("http://x/price"),
                 some.store.terms().literal("low"));
  transaction.commit();
  EXPECT_FALSE(ask(cell.world.graph(), "x:bolt x:price \"low\""));

  // Graphs of the past.
  FactHistory history;
  history.observe(cell.world.graph(), at_s(5));
  JudgedFacts all_past = access.participant(kTask).read().facts_at(history, at_s(5));
  EXPECT_TRUE(ask(all_past.store, "x:bolt x:price ?price"));
  JudgedFacts past = access.participant(kOther).read().facts_at(history, at_s(5));
  EXPECT_FALSE(ask(past.store, "x:bolt x:price ?price"));
  EXPECT_FALSE(ask(past.store, "x:seen ?any ?thing"));
}

TEST(Access, ASceneIsSavedWithoutTheValuesOfOthers) {
  Cell cell;
  Access access(cell.world, rights_of_the_cell(), cell.audit);
  const auto saved = [&](const std::string& who) {
    graph::Store store;
    Report report;
    access.participant(who).read().write_scene({}, store, report);
    const bool value = ask(store, "x:seen w:value ?value");
    EXPECT_EQ(report.problems().size(), value ? 0u : 1u);
    EXPECT_TRUE(ask(store, "x:lying w:measured-by x:seen"));
    return value;
  };
  EXPECT_TRUE(saved(kTask));
  EXPECT_FALSE(saved(kOther));
}

TEST(Access, SpaceHasNoPlaceForWhatOneMayNotRead) {
  Cell cell;
  Access access(cell.world, rights_of_the_cell(), cell.audit);
  const auto found = [&](const std::string& who) {
    const Participant participant = access.participant(who);
    Space space(participant.read(), cell.base);
    space.add(cell.bolt, {{Box{{0.1, 0.1, 0.1}}, {}}});
    space.update(at_s(1));
    return space.within(cell.base, {{Box{{10, 10, 10}}, {}}}, Match::kTouching);
  };
  EXPECT_EQ(found(kTask).bodies.size(), 1u);
  EXPECT_EQ(found(kOther).bodies.size(), 0u);
  EXPECT_EQ(found(kOther).unplaced.size(), 1u);
  EXPECT_EQ(cell.audit->entries().back().what, kSeen);
}

TEST(Access, ConditionsOfTriggersReadAsTheirListener) {
  Cell cell;
  Access access(cell.world, rights_of_the_cell(), cell.audit);
  Triggers triggers(cell.world);
  const auto queue = std::make_shared<EventQueue>();
  int heard = 0;
  for (const std::string& who : {kTask, kOther}) {
    access.participant(who).read().listen(
        triggers,
        {.when = JudgedCondition{[&](const Reader& reader, Stamp now) {
           return reader.latest(cell.seen, now).values[4] > 0;
         }},
         .callback = [&](const Event&) { ++heard; }},
        queue);
  }
  triggers.look(at_s(1));
  queue->run();
  EXPECT_EQ(heard, 1);
}

TEST(Access, WhatWasHandedOutIsTakenBackWhenTheRightsChange) {
  Cell cell;
  Access access(cell.world, rights_of_the_cell(), cell.audit);
  Participant task = access.participant(kTask), camera = access.participant(kCamera);
  PreparedPose pose = task.read().prepare_pose(cell.query());
  const std::vector<PreparedPose> copies = {pose};
  PreparedMotion motion = task.read().prepare_motion(cell.query());
  Triggers triggers(cell.world);
  const auto queue = std::make_shared<EventQueue>();
  int heard = 0;
  task.read().listen(
      triggers, {.when = OnChange{cell.seen}, .callback = [&](const Event&) { ++heard; }}, queue);
  Writer writer = camera.claim(cell.seen);
  ASSERT_EQ(writer.write(at_s(2), Pose{{}, {2, 0, 0}}), Status::kOk);
  ASSERT_EQ(pose.latest_realtime(at_s(2)).pose.p.x, 2);
  triggers.look(at_s(2));
  queue->run();
  EXPECT_EQ(heard, 1);

  Rights harder = rights_of_the_cell();
  harder.forbid(kTask, Act::kRead, kSeen);
  access.change(harder);
  const std::size_t before = allocations();
  EXPECT_EQ(pose.latest_realtime(at_s(2)).status, Status::kForbidden);
  EXPECT_EQ(pose.at_realtime(at_s(1)).status, Status::kForbidden);
  EXPECT_EQ(copies[0].latest_common_realtime().status, Status::kForbidden);
  EXPECT_EQ(motion.latest_realtime(at_s(2)).status, Status::kForbidden);
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(writer.write(at_s(3), Pose{}), Status::kOk);  // it still may
  triggers.look(at_s(3));
  queue->run();
  EXPECT_EQ(heard, 1);

  harder.forbid(kCamera, Act::kMeasure, kSeen);
  access.change(harder);
  EXPECT_EQ(writer.write(at_s(4), Pose{}), Status::kForbidden);
  EXPECT_EQ(cell.world.latest(cell.seen, at_s(4)).stamp, at_s(3));

  access.change(rights_of_the_cell());
  EXPECT_EQ(pose.latest_realtime(at_s(3)).status, Status::kOk);
  EXPECT_EQ(writer.write(at_s(4), Pose{}), Status::kOk);
}

TEST(Access, AnActionIsPerformedAsOneselfAndPredictedForOneself) {
  Cell cell;
  Rights rights = rights_of_the_cell();
  rights.allow(kTask, Act::kPerform, "http://x/note");
  Access access(cell.world, rights, cell.audit);
  Actions actions;
  actions.add({.name = "http://x/note",
               .effect = "INSERT DATA { <http://x/bolt> <http://x/is> \"noted\" . GRAPH "
                         "<http://x/notes> { <http://x/bolt> <http://x/seen> \"twice\" } }"});
  Participant task = access.participant(kTask), other = access.participant(kOther);
  EXPECT_TRUE(
      is_refused([&] { other.perform(actions, "http://x/note", {}, at_s(2)); }, "http://x/note"));
  const Participant::Prediction predicted = other.predict(actions, "http://x/note", {}, at_s(2));
  ASSERT_EQ(predicted.outcome.begun.size(), 1u);  // not what is noted
  EXPECT_TRUE(
      is_refused([&] { predicted.participant.read().pose(cell.part, cell.base, at_s(1)); }));
  EXPECT_EQ(task.predict(actions, "http://x/note", {}, at_s(2)).outcome.begun.size(), 2u);
  EXPECT_EQ(task.perform(actions, "http://x/note", {}, at_s(2)).begun.size(), 2u);
}

}  // namespace
}  // namespace sinew::world
