// What is where: regions by volume and by name, following what moves; the index against looking at
// every body.
#include "sinew/world/space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "random_shapes.h"
#include "sinew/world/edit.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

constexpr WriteContext kCamera{"http://cell/camera"};
constexpr WriteContext kConfiguration{"http://cell/configuration"};

std::vector<Shape> cube(double size) { return {{Box{{size, size, size}}, {}}}; }

// A cell with a shelf on which there is a storage magazine, and parts that a camera sees.
struct Cell {
  World world;
  FrameId cell = world.add_frame("http://cell/cell");
  FrameId shelf = world.add_frame("http://cell/shelf");
  MeasurementId mounted = world.add_static("http://cell/pose-shelf", shelf, cell,
                                           translation(2, 0, 1), kConfiguration.provenance);
  Space space{world, cell};
  BodyId magazine = space.add_area("http://cell/storage-magazine", shelf,
                                   {{Box{{0.6, 0.4, 0.4}}, translation(0, 0, 0.2)}});

  struct Part {
    FrameId frame;
    ObjectId object;
    MeasurementId seen;
    BodyId body;
  };
  Part part(const std::string& name) {
    const FrameId frame = world.add_frame("http://cell/frame-" + name);
    const ObjectId object = world.add_object("http://cell/" + name, frame);
    const RelationId pose = world.add_relation(
        {.name = "http://cell/pose-" + name, .of = frame, .with_respect_to = cell});
    const MeasurementId seen = world.add_measurement(
        {.name = "http://cell/seen-" + name,
         .relation = pose,
         .model = {.life_cycle = TimeDependent{.validity = std::chrono::milliseconds(100)},
                   .provenance = std::string(kCamera.provenance)}});
    return {frame, object, seen, space.add(object, cube(0.1))};
  }
  std::vector<BodyId> in_magazine(Match match) {
    return space.within("http://cell/storage-magazine", match).bodies;
  }
};

using Bodies = std::vector<BodyId>;

TEST(Space, TellsWhatIsInANamedArea) {
  Cell c;
  const auto cup = c.part("cup"), bolt = c.part("bolt"), box = c.part("box");
  c.world.write(cup.seen, at_s(1), translation(2, 0, 1.2), kCamera);     // in the middle
  c.world.write(bolt.seen, at_s(1), translation(2.3, 0, 1.2), kCamera);  // half outside
  c.world.write(box.seen, at_s(1), translation(2.36, 0, 1.2), kCamera);  // 1 cm beside it
  c.space.update(at_s(1));
  EXPECT_EQ(c.in_magazine(Match::kTouching), (Bodies{cup.body, bolt.body}));
  EXPECT_EQ(c.in_magazine(Match::kInside), Bodies{cup.body});
  EXPECT_EQ(c.space.name(cup.body), "http://cell/cup");
}

TEST(Space, FollowsWhatMovesAndWhatTheAreaIsOn) {
  Cell c;
  const auto cup = c.part("cup");
  c.world.write(cup.seen, at_s(1), translation(2, 0, 1.2), kCamera);
  c.space.update(at_s(1));
  ASSERT_EQ(c.in_magazine(Match::kInside), Bodies{cup.body});

  c.world.write(cup.seen, at_s(2), translation(5, 0, 1.2), kCamera);
  EXPECT_EQ(c.in_magazine(Match::kInside), Bodies{cup.body}) << "as of the last update";
  EXPECT_EQ(c.space.update(at_s(2)).moved, 1u);
  EXPECT_EQ(c.in_magazine(Match::kInside), Bodies{});

  // The shelf's place is another one: a structural edit, as its measurement was static.
  c.world.remove(c.world.find_relation("http://cell/pose-shelf"));
  c.world.add_static("http://cell/pose-shelf-moved", c.shelf, c.cell, translation(5, 0, 1),
                     kConfiguration.provenance);
  c.space.update(at_s(2));
  EXPECT_EQ(c.in_magazine(Match::kInside), Bodies{cup.body});
}

TEST(Space, AttachedObjectsMoveWithWhatTheyAreAttachedTo) {
  Cell c;
  const auto cup = c.part("cup"), gripper = c.part("gripper");
  c.world.write(cup.seen, at_s(1), translation(0, 0, 0), kCamera);
  c.world.write(gripper.seen, at_s(1), translation(0, 0, 0.3), kCamera);
  c.space.update(at_s(1));
  EXPECT_EQ(c.in_magazine(Match::kTouching), Bodies{});
  c.world.attach(cup.frame, gripper.frame, at_s(1), kConfiguration.provenance);
  c.world.write(gripper.seen, at_s(2), translation(2, 0, 1.5), kCamera);
  c.space.update(at_s(2));
  EXPECT_EQ(c.in_magazine(Match::kInside), Bodies{cup.body});

  Edit edit = c.world.edit();
  edit.set_frame(cup.object, c.cell);  // an object on another frame
  edit.commit();
  c.space.update(at_s(2));
  EXPECT_EQ(c.in_magazine(Match::kTouching), Bodies{});
}

TEST(Space, NamesInEveryAnswerWhatHasNoPose) {
  Cell c;
  const auto cup = c.part("cup"), never_seen = c.part("never-seen");
  c.world.write(cup.seen, at_s(1), translation(2, 0, 1.2), kCamera);
  EXPECT_EQ(c.space.update(at_s(1)).unplaced, 1u);
  const RegionAnswer answer = c.space.within(c.magazine, Match::kInside);
  EXPECT_EQ(answer.bodies, Bodies{cup.body});
  EXPECT_EQ(answer.unplaced, Bodies{never_seen.body});
  EXPECT_EQ(c.space.pose(never_seen.body).status, Status::kNoData);
}

TEST(Space, WithTheFilterPolicyAnExpiredPoseIsNone) {
  Cell c;
  const auto cup = c.part("cup");
  Space strict(c.world, c.cell, Policy::kFilter);
  const BodyId body = strict.add(cup.object, cube(0.1));
  c.world.write(cup.seen, at_s(1), translation(2, 0, 1.2), kCamera);
  strict.update(at_s(1.05));
  const std::vector<Shape> around = {{Sphere{1}, {}}};
  EXPECT_EQ(strict.within(c.shelf, around, Match::kTouching).bodies, Bodies{body});
  strict.update(at_s(1.2));
  EXPECT_EQ(strict.within(c.shelf, around, Match::kTouching).unplaced, Bodies{body});
  EXPECT_EQ(strict.pose(body).status, Status::kExpired);
  c.space.update(at_s(1.2));
  EXPECT_EQ(c.in_magazine(Match::kInside), Bodies{cup.body});
}

TEST(Space, LetsGoOfRemovedObjects) {
  Cell c;
  const auto cup = c.part("cup"), bolt = c.part("bolt");
  for (const auto& part : {cup, bolt}) {
    c.world.write(part.seen, at_s(1), translation(2, 0, 1.2), kCamera);
  }
  c.space.update(at_s(1));
  c.world.remove(cup.object);
  c.space.remove(bolt.body);
  c.space.update(at_s(1));
  EXPECT_EQ(c.in_magazine(Match::kTouching), Bodies{});
  EXPECT_EQ(c.space.bodies(), Bodies{});
  EXPECT_FALSE(c.space.find("http://cell/cup"));
  EXPECT_THROW(c.space.name(bolt.body), Error);
}

TEST(Space, AnAreaThatWasAddedSinceTheLastUpdateHasNoAnswerYet) {
  Cell c;
  c.space.update(at_s(1));
  const BodyId late = c.space.add_area("http://cell/late", c.shelf, cube(1));
  EXPECT_EQ(c.space.within(late, Match::kTouching).status, Status::kNoData);
  c.space.update(at_s(1));
  EXPECT_EQ(c.space.within(late, Match::kTouching).status, Status::kOk);
}

TEST(Space, RefusesWhatCannotBePlaced) {
  Cell c;
  const auto cup = c.part("cup");
  EXPECT_THROW(c.space.add(cup.object, cube(0.1)), Error) << "twice";
  EXPECT_THROW(c.space.add(c.shelf, {}), Error) << "no shape";
  EXPECT_THROW(c.space.add(c.shelf, std::vector<Shape>(kMaximumBodyShapes + 1, cube(1)[0])), Error);
  EXPECT_THROW(c.space.add(c.shelf, {{Box{{1, 1, 1}}, {{0, 0, 0, 2}, {}}}}), Error);
  EXPECT_THROW(c.space.within("http://cell/no-area", Match::kInside), Error);
  EXPECT_THROW(c.space.within(c.cell, cube(-1), Match::kInside), Error);
}

// The oracle looks at every body with the definitions of the shapes; the index must give the same
// while everything moves: a little, within the margin of its boxes, and far.
TEST(Space, AnswersAsLookingAtEveryBodyDoes) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> far(-5, 5), near(-0.03, 0.03);
  constexpr int kFrames = 60, kBodies = 300, kRounds = 12, kRegions = 25;
  World world;
  const FrameId root = world.add_frame("http://scene/root");
  std::vector<FrameId> frames = {root};
  std::vector<MeasurementId> measured;
  std::vector<Pose> poses;
  for (int i = 0; i < kFrames; ++i) {  // a random tree, two levels or more deep
    const std::string number = std::to_string(i);
    const FrameId frame = world.add_frame("http://scene/frame" + number);
    const RelationId relation =
        world.add_relation({.name = "http://scene/pose" + number,
                            .of = frame,
                            .with_respect_to = frames[i < 20 ? 0 : 1 + random() % 20]});
    measured.push_back(world.add_measurement({.name = "http://scene/seen" + number,
                                              .relation = relation,
                                              .model = {.provenance = "http://cell/camera"}}));
    poses.push_back(random_pose(random));
    poses.back().p = {far(random), far(random), far(random)};
    frames.push_back(frame);
  }
  Space space(world, root);
  std::vector<BodyId> bodies;
  for (int i = 0; i < kBodies; ++i) {
    const std::string name = "http://scene/object" + std::to_string(i);
    const ObjectId object = world.add_object(name, frames[random() % frames.size()]);
    std::vector<Shape> shapes;
    for (std::size_t k = 0; k <= random() % 3; ++k) shapes.push_back(random_shape(random));
    bodies.push_back(space.add(object, shapes));
  }
  std::size_t found = 0, moved = 0, reinserted = 0;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (round % 3 == 1) poses[i].p = poses[i].p + Vector3{near(random), near(random), 0};
      if (round % 3 == 2 && random() % 4 == 0) poses[i].p = {far(random), far(random), far(random)};
      ASSERT_EQ(world.write(measured[i], at_s(round + 1), poses[i], kCamera), Status::kOk);
    }
    const auto counts = space.update(at_s(round + 1));
    if (round > 0) moved += counts.moved, reinserted += counts.reinserted;
    for (int k = 0; k < kRegions; ++k) {
      const FrameId frame = frames[random() % frames.size()];
      Shape shape = random_shape(random);
      if (k % 2) shape.geometry = Box{{4, 5, 6}};
      const PoseAnswer X = world.pose(frame, root, at_s(round + 1));
      const Shape region = placed(X.pose, shape);
      Bodies touching, inside;
      for (const BodyId body : bodies) {
        bool any = false, all = true;
        for (const Shape& part : space.shapes(body)) {
          any = any || touch(part, region);
          all = all && protrusion(part, region) <= kTouchingDistance;
        }
        if (any) touching.push_back(body);
        if (all) inside.push_back(body);
      }
      ASSERT_EQ(space.within(frame, {shape}, Match::kTouching).bodies, touching);
      ASSERT_EQ(space.within(frame, {shape}, Match::kInside).bodies, inside);
      found += touching.size() + inside.size();
    }
  }
  EXPECT_GT(found, 1000u);
  EXPECT_LT(reinserted, moved * 2 / 3) << "small motions stay within the boxes of the index";
}

// The shapes that the oracle above looks at are where the world says that they are.
TEST(Space, PlacesShapesByTheWorldsPoses) {
  Cell c;
  const auto cup = c.part("cup");
  std::mt19937_64 random(10);
  const Pose X = random_pose(random), in_cup = random_pose(random);
  const BodyId body = c.space.add(cup.frame, {{Cylinder{0.1, 0.2}, in_cup}});
  c.world.write(cup.seen, at_s(1), X, kCamera);
  c.space.update(at_s(1));
  EXPECT_LT(difference(c.space.shapes(body)[0].placement, compose(X, in_cup)), 1e-15);
}

}  // namespace
}  // namespace sinew::world
