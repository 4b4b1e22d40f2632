// Facts and structure at one instant: whoever looks while an action is performed sees all of it or
// nothing.
#include "sinew/world/situation.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "sinew/rdf/sparql/engine.h"
#include "sinew/world/action_effects.h"
#include "sinew/world/edit.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

const std::string kPrefixes = "PREFIX x: <http://x/> PREFIX w: <https://w3id.org/sinew/world#>\n";

// A gripper one metre above the table; a bolt lies on the table, or hangs on the gripper.
struct Workshop {
  Workshop() {
    table = world.add_frame("http://x/table-frame");
    tool = world.add_frame("http://x/tool-frame");
    bolt = world.add_frame("http://x/bolt-frame");
    const auto measured = [&](const char* name, FrameId of, const Pose& X) {
      const RelationId relation =
          world.add_relation({.name = name, .of = of, .with_respect_to = table});
      const MeasurementId value =
          world.add_measurement({.name = std::string(name) + "/value", .relation = relation});
      world.write(value, at_s(0), X, {"me"});
    };
    measured("http://x/arm-pose", tool, {{}, {0, 0, 1}});
    measured("http://x/bolt-pose", bolt, {{}, {0.5, 0, 0}});
    world.add_object("http://x/bolt", bolt);
    const auto add = [&](const std::string& name, const std::string& effect,
                         const std::string& attach, const std::string& detach,
                         const std::string& adds, const std::string& removes) {
      actions.add({.name = name,
                   .effect = kPrefixes + effect,
                   .attach = attach.empty() ? "" : kPrefixes + attach,
                   .detach = detach.empty() ? "" : kPrefixes + detach,
                   .add = adds.empty() ? "" : kPrefixes + adds,
                   .remove = removes.empty() ? "" : kPrefixes + removes});
    };
    add("http://x/grasp", "INSERT DATA { x:gripper x:holds x:bolt }",
        "SELECT ?frame ?parent WHERE { BIND(x:bolt-frame AS ?frame) BIND(x:tool-frame AS ?parent) "
        "}",
        "",
        "SELECT ?object ?frame ?model WHERE { BIND(x:chips AS ?object) BIND(x:table-frame AS "
        "?frame) BIND(x:dirt AS ?model) }",
        "");
    add("http://x/release", "DELETE DATA { x:gripper x:holds x:bolt }", "",
        "SELECT ?frame ?parent WHERE { BIND(x:bolt-frame AS ?frame) BIND(x:table-frame AS ?parent) "
        "}",
        "", "SELECT ?object WHERE { BIND(x:chips AS ?object) }");
  }
  ActionOutcome perform(const std::string& action, int second) {
    return actions.perform(world, {action, {}, "me", at_s(second)});
  }
  World world;
  Actions actions;
  FrameId table, tool, bolt;
};

TEST(Situation, AnActionAddsAndRemovesObjects) {
  Workshop shop;
  const ActionOutcome grasped = shop.perform("http://x/grasp", 1);
  EXPECT_EQ(grasped.added,
            (std::vector<ObjectAt>{{"http://x/chips", "http://x/table-frame", "http://x/dirt"}}));
  const ObjectId chips = shop.world.find_object("http://x/chips");
  ASSERT_TRUE(chips);
  EXPECT_EQ(shop.world.frame_of(chips), shop.table);
  const ActionOutcome released = shop.perform("http://x/release", 2);
  ASSERT_EQ(released.removed.size(), 1u);
  EXPECT_FALSE(shop.world.find_object("http://x/chips"));
  // There are none to remove: nothing happens at all.
  EXPECT_THROW(shop.perform("http://x/release", 3), Error);
  // Who may perform it, but not change what there is.
  Rights rights;
  rights.allow("me", Act::kPerform, kAnything);
  rights.allow("me", Act::kRelate, kAnything);
  EXPECT_THROW(
      shop.actions.perform(shop.world, {"http://x/grasp", {}, "me", at_s(4)}, {.rights = &rights}),
      Error);
  EXPECT_FALSE(shop.world.find_object("http://x/chips"));
  rights.allow("me", Act::kModel, "http://x/chips");
  shop.actions.perform(shop.world, {"http://x/grasp", {}, "me", at_s(4)}, {.rights = &rights});
  EXPECT_TRUE(shop.world.find_object("http://x/chips"));
}

TEST(Situation, StaysAsItIs) {
  Workshop shop;
  const Situation before = shop.world.situation();
  shop.perform("http://x/grasp", 1);
  const Situation after = shop.world.situation();
  graph::Terms& terms = shop.world.graph().terms();
  const auto holds = [&](const Situation& situation) {
    return situation.facts.contains(terms.iri("http://x/gripper"), terms.iri("http://x/holds"),
                                    terms.iri("http://x/bolt"));
  };
  EXPECT_FALSE(holds(before));
  EXPECT_TRUE(holds(after));
  EXPECT_EQ(after.structure_version, before.structure_version + 1);
  EXPECT_EQ(before.structure.objects.size() + 1, after.structure.objects.size());
}

// One performs, three look: the fact, the description and the structure are never at odds.
TEST(Situation, FactsDescriptionAndStructureChangeAtOneInstant) {
  Workshop shop;
  shop.perform("http://x/grasp", 1);  // every term is known from now on
  graph::Terms& terms = shop.world.graph().terms();
  const graph::Id gripper = terms.iri("http://x/gripper"), holds = terms.iri("http://x/holds"),
                  bolt = terms.iri("http://x/bolt"), chips = terms.iri("http://x/chips"),
                  attached = terms.iri("https://w3id.org/sinew/world#attached-to"),
                  table = terms.iri("http://x/table-frame");
  std::atomic<bool> stop = false;
  std::atomic<std::uint64_t> wrong = 0, with = 0, without = 0;
  std::vector<std::thread> threads;
  for (int k = 0; k < 3; ++k) {
    threads.emplace_back([&] {
      while (!stop) {
        const Situation now = shop.world.situation();
        const bool fact = now.facts.contains(gripper, holds, bolt);
        const bool described = now.facts.contains(chips, attached, table);
        bool there = false, hangs = false;
        for (Index i = 0; i < now.structure.objects.size(); ++i) {
          const ObjectRecord& object = now.structure.objects[i];
          there = there || (object.alive && object.frame == shop.table.index);
        }
        for (Index i = 0; i < now.structure.relations.size(); ++i) {
          const RelationRecord& relation = now.structure.relations[i];
          hangs = hangs || (relation.alive && relation.attachment);
        }
        wrong += fact != described || fact != there || fact != hangs;
        // The way that the pose takes is that of the same instant.
        const PoseAnswer pose = now.pose(shop.bolt, shop.tool, at_s(0));
        wrong += pose.status != Status::kOk;
        ++(fact ? with : without);
      }
    });
  }
  for (int i = 0; i < 150 || ((with == 0 || without == 0) && i < 20'000); ++i) {
    shop.perform("http://x/release", 2 * i + 2);
    shop.perform("http://x/grasp", 2 * i + 3);
  }
  stop = true;
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(with, 0u);
  EXPECT_GT(without, 0u);
}

}  // namespace
}  // namespace sinew::world
