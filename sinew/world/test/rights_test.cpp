// Rights by provenance: the source's Table 3.1 on the assembly cell, rules, audits, and conflicts
// that are found before anything runs.
#include "sinew/world/rights.h"

#include <gtest/gtest.h>

#include <thread>

#include "refusal.h"
#include "sinew/graph/store.h"
#include "sinew/model/load.h"
#include "sinew/world/declared_rights.h"
#include "sinew/world/edit.h"
#include "sinew/world/scene.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

const std::string kCell = "https://w3id.org/sinew/examples/assembly_cell#";
const std::string kCamera = kCell + "camera-device", kController = kCell + "robot-controller";
const std::string kTask = kCell + "task-controller";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// The cell with the robot's controller as a provider, and the rights of its components.
struct CellWithRights {
  explicit CellWithRights(const std::string& more_turtle = "") {
    graph::Store store;
    graph::Places places;
    std::vector<std::filesystem::path> paths;
    for (const char* file :
         {"scene.jsonld", "task.jsonld", "measured.jsonld", "components.jsonld"}) {
      paths.emplace_back(std::string(SINEW_SOURCE_DIR "/examples/assembly_cell/") + file);
    }
    Report loading;
    model::load_files(paths, {}, store, places, loading);
    const std::string turtle = "@prefix w: <https://w3id.org/sinew/world#> .\n@prefix cell: <" +
                               kCell + "> .\n" + more_turtle;
    const model::Source source{"more.ttl", turtle};
    model::load({&source, 1}, {}, store, places, loading);
    loading.throw_if_errors();
    load_scene(world, store, places, loading);
    loading.throw_if_errors();
    declared = read_rights(store, places, report);
    check_configuration(world, declared, report);
  }
  MeasurementId measurement(const std::string& name) const {
    return world.find_measurement(kCell + name);
  }
  FrameId frame(const std::string& name) const { return world.find_frame(kCell + name); }

  World world;
  DeclaredRights declared;
  Report report;  // of the rights and the configuration
};

TEST(Rights, TheCellsConfigurationHasNoConflict) {
  const CellWithRights cell;
  EXPECT_TRUE(cell.report.problems().empty()) << to_string(cell.report.problems().front());
  EXPECT_EQ(cell.declared.writers.size(), 2u);
  EXPECT_EQ(cell.declared.readers.size(), 2u);
  EXPECT_EQ(cell.declared.components, (std::set<std::string>{kCamera, kController, kTask}));
  EXPECT_EQ(cell.declared.rights.size(), 1u);
}

TEST(Rights, TheCameraDoesNotWriteWhatTheRobotControllerMeasures) {
  CellWithRights cell;
  const auto audit = std::make_shared<Audit>();
  enforce(cell.world, cell.declared.rights, audit);
  const MeasurementId arm = cell.measurement("measured-F5-F4");
  const std::string refused = refusal([&] { cell.world.write(arm, at_s(1), Pose{}, {kCamera}); });
  EXPECT_TRUE(has(refused, kCamera)) << refused;
  EXPECT_TRUE(has(refused, kController)) << refused;
  EXPECT_TRUE(has(refused, kCell + "measured-F5-F4")) << refused;
  EXPECT_EQ(cell.world.latest(arm, at_s(1)).status, Status::kNoData);
  // Nor through a handle, nor in a batch that holds its own measurement too.
  EXPECT_TRUE(has(refusal([&] { cell.world.claim(arm, {kCamera}); }), kController));
  const double values[7] = {0, 0, 0, 1, 0, 0, 1};
  const MeasurementId seen = cell.measurement("measured-F2-F3");
  const World::Value both[] = {{seen, values}, {arm, values}};
  EXPECT_TRUE(
      has(refusal([&] { cell.world.write_together(at_s(1), both, {kCamera}); }), kController));
  EXPECT_EQ(cell.world.latest(seen, at_s(1)).status, Status::kNoData);
  EXPECT_NE(refusal([&] { cell.world.write(seen, at_s(1), Pose{}, {""}); }), "none");

  EXPECT_EQ(cell.world.write(seen, at_s(1), Pose{}, {kCamera}), Status::kOk);
  EXPECT_EQ(cell.world.write(arm, at_s(1), Pose{}, {kController}), Status::kOk);

  const auto entries = audit->entries();
  ASSERT_EQ(entries.size(), 7u);
  EXPECT_FALSE(entries[0].accepted);
  EXPECT_EQ(entries[0].who, kCamera);
  EXPECT_EQ(entries[0].what, kCell + "measured-F5-F4");
  EXPECT_TRUE(has(entries[0].reason, kController));
  EXPECT_TRUE(entries[2].accepted);  // its own, in the batch that was refused for the other
  EXPECT_TRUE(entries[6].accepted);
  EXPECT_EQ(entries[6].who, kController);
  EXPECT_EQ(audit->counts().accepted, 3u);
  EXPECT_EQ(audit->counts().refused, 4u);
}

// Each row of the table: its provenance may, the other two may not.
TEST(Rights, EveryMeasurementOfTheTableHasOneWriter) {
  const CellWithRights cell;
  const std::string configuration = kCell + "configuration";
  const std::pair<std::string, std::string> table[] = {{"measured-F1-F0", configuration},
                                                       {"measured-F3-F0", configuration},
                                                       {"measured-F4-F0", configuration},
                                                       {"measured-F2-F3", kCamera},
                                                       {"measured-F5-F4", kController}};
  for (const auto& [name, provenance] : table) {
    ASSERT_TRUE(cell.measurement(name)) << name;
    const auto model = cell.world.model(cell.measurement(name));
    EXPECT_EQ(model->provenance, provenance);
    for (const std::string& who : {configuration, kCamera, kController}) {
      const auto reason =
          cell.declared.rights.reason_against(who, Act::kMeasure, kCell + name, model->provenance);
      EXPECT_EQ(!reason, who == provenance) << name << " by " << who;
    }
  }
}

TEST(Rights, RulesAllowAndForbidAndToForbidIsStronger) {
  Rights rights;
  const auto may = [&](const std::string& who, const std::string& what) {
    return !rights.reason_against(who, Act::kMeasure, what, "http://x/owner");
  };
  EXPECT_TRUE(may("http://x/owner", "http://x/m"));
  EXPECT_FALSE(may("http://x/guest", "http://x/m"));
  rights.allow("http://x/guest", Act::kMeasure, "http://x/m");
  EXPECT_TRUE(may("http://x/guest", "http://x/m"));
  EXPECT_FALSE(may("http://x/guest", "http://x/n"));
  rights.allow("http://x/guest", Act::kMeasure, kAnything);
  EXPECT_TRUE(may("http://x/guest", "http://x/n"));
  rights.forbid("http://x/guest", Act::kMeasure, "http://x/n");
  EXPECT_FALSE(may("http://x/guest", "http://x/n"));
  rights.allow("http://x/guest", Act::kMeasure, "http://x/n");  // whatever the order
  EXPECT_FALSE(may("http://x/guest", "http://x/n"));
  rights.forbid("http://x/owner", Act::kMeasure, kAnything);
  EXPECT_FALSE(may("http://x/owner", "http://x/m"));
  EXPECT_NE(refusal([&] { rights.allow("", Act::kModel, "http://x/m"); }), "none");
}

TEST(Rights, RelationsAndModelsAreChangedByWhoeverIsAllowed) {
  CellWithRights cell;
  const auto audit = std::make_shared<Audit>();
  ASSERT_EQ(cell.world.write(cell.measurement("measured-F2-F3"), at_s(1), Pose{}, {kCamera}),
            Status::kOk);
  ASSERT_EQ(cell.world.write(cell.measurement("measured-F5-F4"), at_s(1), Pose{}, {kController}),
            Status::kOk);
  Actor camera(cell.world, cell.declared.rights, kCamera, audit);
  Actor task(cell.world, cell.declared.rights, kTask, audit);
  const auto version = cell.world.structure_version();
  const std::string refused =
      refusal([&] { camera.attach(cell.frame("F2"), cell.frame("F5"), at_s(1)); });
  EXPECT_TRUE(has(refused, kCamera) && has(refused, kCell + "F2")) << refused;
  EXPECT_NE(refusal([&] { task.add_object("http://x/bolt", cell.frame("F2")); }), "none");
  EXPECT_NE(refusal([&] { task.remove(cell.world.find_relation(kCell + "pose-F2-F3")); }), "none");
  EXPECT_EQ(cell.world.structure_version(), version);

  EXPECT_EQ(refusal([&] { task.attach(cell.frame("F2"), cell.frame("F5"), at_s(1)); }), "none");
  EXPECT_GT(cell.world.structure_version(), version);
  Rights more = cell.declared.rights;
  more.allow(kTask, Act::kModel, kAnything);
  Actor builder(cell.world, more, kTask, audit);
  EXPECT_TRUE(builder.add_object("http://x/bolt", cell.frame("F2")));
  EXPECT_EQ(audit->counts().refused, 3u);
  EXPECT_EQ(audit->counts().accepted, 2u);
  EXPECT_EQ(audit->entries().front().act, Act::kRelate);
}

TEST(Rights, AStaticMeasurementWithAWriterIsFoundBeforeTheStart) {
  const CellWithRights cell("cell:robot-controller w:writes cell:measured-F4-F0 .\n");
  ASSERT_TRUE(cell.report.has_errors());
  const std::string conflict = to_string(cell.report.problems().front());
  EXPECT_TRUE(has(conflict, "static")) << conflict;
  EXPECT_TRUE(has(conflict, kController)) << conflict;
  EXPECT_TRUE(has(conflict, kCell + "measured-F4-F0")) << conflict;
}

TEST(Rights, ConflictsHaveAPlace) {
  const CellWithRights cell(
      "cell:intruder a w:Component ;\n"  // line 3
      "  w:writes cell:measured-F5-F4 , cell:nothing .\n"
      "cell:r1 a w:Allowance ; w:who cell:intruder ; w:what w:Anything ; w:act \"fly\" .\n"
      "cell:r2 a w:Prohibition ; w:act \"change-model\" ; w:what w:Anything .\n");
  std::string all;
  for (const Problem& problem : cell.report.problems()) all += to_string(problem) + "\n";
  EXPECT_TRUE(has(all, "more.ttl:4")) << all;
  EXPECT_TRUE(has(all, "its provenance is " + kController)) << all;
  EXPECT_TRUE(has(all, "it is no measurement of this world")) << all;
  EXPECT_TRUE(has(all, "there is no act 'fly'")) << all;
  EXPECT_TRUE(has(all, "the rule does not say who")) << all;
  EXPECT_TRUE(has(all, "two write it")) << all;
}

TEST(Rights, WhatChangesAndNobodyWritesIsAWarning) {
  World world;
  const FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b");
  const RelationId relation =
      world.add_relation({.name = "http://x/r", .of = b, .with_respect_to = a});
  world.add_measurement(
      {.name = "http://x/m", .relation = relation, .model = {.provenance = "http://x/p"}});
  Report report;
  check_configuration(world, {}, {}, report);
  ASSERT_EQ(report.problems().size(), 1u);
  EXPECT_EQ(report.problems()[0].severity, Severity::kWarning);
  EXPECT_FALSE(report.has_errors());
}

TEST(Rights, AMeasurementThatCameLaterIsJudgedByItsProvenance) {
  CellWithRights cell;
  enforce(cell.world, cell.declared.rights);
  const RelationId relation = cell.world.find_relation(kCell + "pose-F5-F4");
  const MeasurementId later = cell.world.add_measurement(
      {.name = "http://x/later", .relation = relation, .model = {.provenance = "http://x/p"}});
  EXPECT_EQ(cell.world.write(later, at_s(1), Pose{}, {"http://x/p"}), Status::kOk);
  EXPECT_TRUE(
      has(refusal([&] { cell.world.write(later, at_s(2), Pose{}, {kCamera}); }), "http://x/p"));
}

TEST(Audit, KeepsTheLastEntriesAndCountsWhatItDrops) {
  Stamp now = at_s(5);
  Audit audit(3, [&] { return now; });
  for (int i = 0; i < 5; ++i) {
    audit.record({.accepted = i % 2 == 0,
                  .who = std::to_string(i),
                  .what = {},
                  .measurement = {},
                  .reason = {}});
  }
  const auto entries = audit.entries();
  ASSERT_EQ(entries.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(entries[i].number, i + 2);
    EXPECT_EQ(entries[i].who, std::to_string(i + 2));
    EXPECT_EQ(entries[i].when, at_s(5));
  }
  EXPECT_EQ(audit.counts().accepted, 3u);
  EXPECT_EQ(audit.counts().refused, 2u);
  EXPECT_EQ(audit.counts().dropped, 2u);
  EXPECT_NE(refusal([] { Audit none(0); }), "none");
  EXPECT_NE(refusal([] { Audit huge(kMaximumAuditEntries + 1); }), "none");
}

TEST(Audit, CountsEveryWriteOfManyThreads) {
  CellWithRights cell;
  const auto audit = std::make_shared<Audit>(16);
  enforce(cell.world, cell.declared.rights, audit);
  const MeasurementId seen = cell.measurement("measured-F2-F3");
  constexpr int kWrites = 200;
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&, thread] {
      for (int i = 0; i < kWrites; ++i) {
        const std::string& who = thread == 0 ? kController : kCamera;
        try {
          cell.world.write(seen, at_s(1 + 0.001 * i), Pose{}, {who});
        } catch (const Error&) {  // refused, which is an answer too
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(audit->counts().refused, static_cast<std::uint64_t>(kWrites));
  EXPECT_EQ(audit->counts().accepted, static_cast<std::uint64_t>(3 * kWrites));
  EXPECT_EQ(audit->counts().dropped, static_cast<std::uint64_t>(4 * kWrites - 16));
  EXPECT_EQ(audit->entries().back().number, static_cast<std::uint64_t>(4 * kWrites - 1));
}

}  // namespace
}  // namespace sinew::world
