// Who may read: by declared users, rules, and provenance; judged once for a prepared query.
#include "sinew/world/reader.h"

#include <gtest/gtest.h>

#include "allocations.h"
#include "refusal.h"
#include "seen_part.h"
#include "sinew/graph/store.h"
#include "sinew/model/load.h"
#include "sinew/world/declared_rights.h"
#include "sinew/world/edit.h"

namespace sinew::world {
namespace {

struct Cell : SeenPart {
  Cell() : SeenPart({kTask, "http://x/planner"}) {}
};

TEST(Reader, OnlyDeclaredUsersGetAnAnswer) {
  Cell cell;
  const Reader task(cell.world, Rights(), kTask), camera(cell.world, Rights(), kCamera),
      other(cell.world, Rights(), kOther), nobody(cell.world, Rights(), "");
  for (const Reader& may : {task, camera}) {
    EXPECT_EQ(may.pose(cell.part, cell.base, at_s(1)).status, Status::kOk);
    EXPECT_EQ(may.latest(cell.seen, at_s(1)).status, Status::kOk);
    EXPECT_EQ(may.at(cell.seen, at_s(1)).status, Status::kOk);
    EXPECT_EQ(may.history(cell.seen).size(), 1u);
    EXPECT_EQ(may.model(cell.seen)->provenance, kCamera);
  }
  const std::string expected =
      "http://x/seen: http://x/other may not read it: its users are http://x/task, "
      "http://x/planner; name it in used_by";
  for (const std::string& got :
       {refusal([&] { other.prepare_pose(cell.query()); }),
        refusal([&] { other.prepare_motion(cell.query()); }),
        refusal([&] { other.latest(cell.seen, at_s(1)); }),
        refusal([&] { other.at(cell.seen, at_s(1)); }), refusal([&] { other.history(cell.seen); }),
        refusal([&] { other.model(cell.seen); })}) {
    EXPECT_EQ(got.substr(0, expected.size()), expected);
  }
  EXPECT_NE(refusal([&] { nobody.latest(cell.seen, at_s(1)); }).find("does not say who it is"),
            std::string::npos);
  // What names no users is everybody's.
  EXPECT_EQ(other.pose(cell.table, cell.base, at_s(1)).status, Status::kOk);
}

TEST(Reader, RulesAreStrongerThanDeclaredUsers) {
  Cell cell;
  Rights rights;
  rights.allow(kOther, Act::kRead, "http://x/seen");
  rights.forbid(kTask, Act::kRead, kAnything);
  EXPECT_EQ(Reader(cell.world, rights, kOther).latest(cell.seen, at_s(1)).status, Status::kOk);
  const Reader task(cell.world, rights, kTask);
  EXPECT_NE(refusal([&] { task.latest(cell.seen, at_s(1)); }).find("a rule forbids it"),
            std::string::npos);
  // Also a constant on the way, of which no user is declared.
  EXPECT_NE(refusal([&] { task.pose(cell.table, cell.base, at_s(1)); }), "none");
}

TEST(Reader, IsJudgedWhenItIsPreparedAndNotWhenItReads) {
  Cell cell;
  const auto audit = std::make_shared<Audit>();
  const Reader task(cell.world, Rights(), kTask, audit);
  PreparedPose prepared = task.prepare_pose(cell.query());
  const auto judged = audit->counts().accepted;
  EXPECT_EQ(judged, 2u);  // the constant, and what is seen
  const std::size_t before = allocations();
  for (int i = 0; i < 100; ++i) ASSERT_EQ(prepared.latest_realtime(at_s(1)).status, Status::kOk);
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(prepared.latest(at_s(1)).status, Status::kOk);
  EXPECT_EQ(audit->counts().accepted, judged);
}

// A new plan is judged before it is used: nobody comes by a detour to what he may not read.
TEST(Reader, ANewPlanIsJudgedToo) {
  Cell cell;
  const auto audit = std::make_shared<Audit>();
  const Reader task(cell.world, Rights(), kTask, audit);
  PreparedPose prepared = task.prepare_pose(cell.query());
  PreparedPose copy = prepared;
  const MeasurementId secret = cell.world.add_measurement(
      {.name = "http://x/secret",
       .relation = cell.lying,
       .model = {.provenance = "http://x/radar", .used_by = {"http://x/planner"}}});
  cell.world.write(secret, at_s(2), Pose{{}, {7, 0, 0}}, {"http://x/radar"});
  EXPECT_EQ(refusal([&] { prepared.latest(at_s(2)); }).substr(0, 15), "http://x/secret");
  EXPECT_EQ(refusal([&] { copy.refresh(); }).substr(0, 15), "http://x/secret");
  // In real time the plan of before goes on, and says that it is old.
  const PoseAnswer answer = prepared.latest_realtime(at_s(2));
  EXPECT_EQ(answer.pose.p.x, 1);
  EXPECT_TRUE(answer.structure_changed);
  // Chosen by provenance, the secret is none of its plan.
  PoseQuery query = cell.query();
  query.choice = Choice::kByProvenance;
  query.provenances = {kCamera, "http://x/me"};
  EXPECT_EQ(task.prepare_pose(query).latest(at_s(2)).pose.p.x, 1);
  const auto refused = audit->entries();
  EXPECT_TRUE(std::any_of(refused.begin(), refused.end(), [&](const AuditEntry& entry) {
    return !entry.accepted && entry.act == Act::kRead && entry.who == kTask &&
           entry.what == "http://x/secret" && entry.measurement == secret;
  }));
}

// ---- before the start ----

struct Configured {
  explicit Configured(const std::string& turtle) {
    graph::Store store;
    graph::Places places;
    Report loading;
    const std::string text =
        "@prefix w: <https://w3id.org/sinew/world#> . @prefix x: <http://x/> .\n" + turtle;
    const model::Source source{"rights.ttl", text};
    model::load({&source, 1}, {}, store, places, loading);
    declared = read_rights(store, places, loading);
    loading.throw_if_errors();
    check_configuration(cell.world, declared, report);
  }
  std::vector<std::string> errors() const {
    std::vector<std::string> found;
    for (const Problem& problem : report.problems()) {
      if (problem.severity == Severity::kError) found.push_back(to_string(problem));
    }
    return found;
  }
  Cell cell;
  DeclaredRights declared;
  Report report;
};

const std::string kComponents =
    "x:camera a w:Component ; w:writes x:seen . x:task a w:Component ; w:reads x:seen .\n"
    "x:planner a w:Component .\n";

TEST(ReadConfiguration, WhatFitsHasNoConflict) {
  EXPECT_TRUE(Configured(kComponents).errors().empty());
}

TEST(ReadConfiguration, ConflictsAreFoundBeforeTheStartWithTheirPlace) {
  struct Case {
    std::string turtle, expected;
  };
  const Case cases[] = {
      {"x:other a w:Component ; w:reads x:seen .",
       "rights.ttl:4: http://x/seen: http://x/other is to read it, but http://x/other may not read "
       "it"},
      {"x:task w:reads x:nothing .",
       "rights.ttl:2: http://x/nothing: http://x/task is to read it, and it is no measurement"},
      {"[] a w:Allowance ; w:who x:ghost ; w:act \"read-measurement\" ; w:what x:seen .",
       "it is about http://x/ghost, which is no declared component"},
      {"x:other a w:Component ; w:writes x:seen . [] a w:Allowance ; w:who x:other ; w:act "
       "\"write-measurement\" ; w:what x:seen . [] a w:SingleWriter ; w:what x:seen .",
       "two write it: http://x/camera and http://x/other, and a rule says that it has a single "
       "writer"}};
  for (const Case& one : cases) {
    const auto errors = Configured(kComponents + one.turtle).errors();
    ASSERT_EQ(errors.size(), 1u) << one.turtle;
    EXPECT_NE(errors[0].find(one.expected), std::string::npos) << errors[0];
  }
  // A user that nobody declares.
  const auto errors =
      Configured("x:camera a w:Component ; w:writes x:seen . x:task a w:Component .").errors();
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].find("its user http://x/planner is no declared component"),
            std::string::npos);
  // A rule lets in whom used_by does not name.
  EXPECT_TRUE(Configured(kComponents +
                         "x:other a w:Component ; w:reads x:seen . [] a w:Allowance ; w:who "
                         "x:other ; w:act \"read-measurement\" ; w:what x:seen .")
                  .errors()
                  .empty());
}

}  // namespace
}  // namespace sinew::world
