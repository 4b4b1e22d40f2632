// Packed links against the lists of the state that they were made of.
#include "sinew/world/links.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "sinew/world/edit.h"
#include "sinew/world/world.h"

namespace sinew::world {
namespace {

using Listed = std::vector<std::pair<Index, Index>>;

Listed by_lists(const State& state, Index frame) {
  Listed found;
  for (Index at = state.frames[frame].first_relation; at != kNone;) {
    const RelationRecord& relation = state.relations[at];
    const bool is_of = relation.of == frame;
    if (relation.kind != RelationKind::kProperty) {
      found.emplace_back(at, is_of ? relation.with_respect_to : relation.of);
    }
    at = is_of ? relation.next_at_of : relation.next_at_with_respect_to;
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Links, AreThoseOfTheStatesListsAfterAnyEdits) {
  std::mt19937 random(11);
  World world;
  std::vector<FrameId> frames;
  std::vector<RelationId> relations;
  int made = 0;
  for (int round = 0; round < 40; ++round) {
    Edit edit = world.edit();
    for (int step = 0; step < 10; ++step) {
      const std::string name = "http://w/" + std::to_string(++made);
      const auto any = [&] { return frames[random() % frames.size()]; };
      const auto what = random() % 10;
      if (frames.size() < 3 || what < 3) {
        frames.push_back(edit.add_frame(name));
      } else if (what < 8) {
        const FrameId of = any(), to = any();
        if (of != to) {
          relations.push_back(edit.add_relation({.name = name, .of = of, .with_respect_to = to}));
        }
      } else if (what == 8) {
        edit.add_relation(
            {.name = name, .of = any(), .with_respect_to = {}, .kind = RelationKind::kProperty});
      } else if (!relations.empty()) {
        std::swap(relations[random() % relations.size()], relations.back());
        edit.remove(relations.back());
        relations.pop_back();
      }
    }
    edit.commit();
    const State state = world.state();
    const Links links(state);
    ASSERT_EQ(links.frames(), state.frames.size());
    EXPECT_EQ(links.size(), 2 * relations.size());
    for (Index frame = 0; frame < links.frames(); ++frame) {
      Listed packed;
      for (const Link link : links.of(frame)) packed.emplace_back(link.relation, link.other);
      EXPECT_TRUE(std::is_sorted(packed.begin(), packed.end())) << "in the order they were made";
      EXPECT_EQ(packed, by_lists(state, frame));
    }
  }
}

TEST(Links, AWorldKeepsThemUntilItsStructureChanges) {
  World world;
  const FrameId a = world.add_frame("http://w/a"), b = world.add_frame("http://w/b");
  const auto none = world.links();
  EXPECT_EQ(none->size(), 0u);
  const RelationId relation =
      world.add_relation({.name = "http://w/r", .of = a, .with_respect_to = b});
  const auto one = world.links();
  EXPECT_EQ(one->size(), 2u);
  ASSERT_EQ(one->of(a.index).size(), 1u);
  EXPECT_EQ(one->of(a.index)[0].other, b.index);
  const MeasurementId pose = world.add_measurement({.name = "http://w/m", .relation = relation});
  const auto same = world.links();
  world.write(pose, Stamp(std::chrono::seconds(1)), Pose{}, {.provenance = "http://w/p"});
  EXPECT_EQ(world.links(), same);
  const World clone = world.clone();
  world.remove(relation);
  EXPECT_EQ(world.links()->size(), 0u);
  EXPECT_EQ(clone.links()->size(), 2u);
  EXPECT_EQ(one->size(), 2u);
}

TEST(Links, OfAnEmptyWorldAreNone) {
  const World world;
  const Links links(world.state());
  EXPECT_EQ(links.size(), 0u);
}

}  // namespace
}  // namespace sinew::world
