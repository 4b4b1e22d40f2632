// What a tree of transforms cannot do, each on random scenes with the truth known, and beside tf2
// where tf2 has an answer of its own: loops, several parents, corrections of the past, removal of a
// frame, clones, extrapolation with a model. (Values in other units: blocks_test.cpp.)
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "random_poses.h"
#include "sinew/world/edit.h"
#include "sinew/world/world.h"
#ifdef SINEW_HAVE_TF2
#include "tf2_buffer.h"
#include "times_and_places.h"
#endif

namespace sinew::world {
namespace {

#ifdef SINEW_HAVE_TF2
Tf2Numbers numbers(const Pose& X) { return {X.q.x, X.q.y, X.q.z, X.q.w, X.p.x, X.p.y, X.p.z}; }
Pose pose(const Tf2Numbers& n) { return {{n[0], n[1], n[2], n[3]}, {n[4], n[5], n[6]}}; }
#endif

// Frames whose poses in the world are known, and measured relations between many pairs of them: all
// consistent, with loops, and most frames with several parents.
struct Web {
  explicit Web(unsigned seed, int frame_count = 12, int relation_count = 30) : random(seed) {
    Edit edit = world.edit();
    for (int i = 0; i < frame_count; ++i) {
      frames.push_back(edit.add_frame("http://web/frame" + std::to_string(i)));
      truth.push_back(random_pose(random));
    }
    for (int i = 0; i < relation_count; ++i) {
      // The first ones connect all frames; the others close loops.
      const std::size_t of =
          i + 1 < frame_count ? static_cast<std::size_t>(i) + 1 : random() % frames.size();
      std::size_t to = random() % (i + 1 < frame_count ? of : frames.size());
      if (to == of) to = (of + 1) % frames.size();
      const std::string name = "http://web/relation" + std::to_string(i);
      relations.push_back(
          {edit.add_relation({.name = name, .of = frames[of], .with_respect_to = frames[to]}),
           {},
           of,
           to});
      relations.back().measurement =
          edit.add_measurement({.name = name + "/m", .relation = relations.back().relation});
    }
    edit.commit();
    write(at_s(1));
  }
  Pose X(std::size_t of, std::size_t to) const { return compose(invert(truth[to]), truth[of]); }
  void write(Stamp stamp) {
    for (const Link& link : relations) {
      world.write(link.measurement, stamp, X(link.of, link.to), {});
    }
  }
  PoseAnswer ask(std::size_t of, std::size_t to, std::vector<RelationId> avoid = {}) const {
    return world
        .prepare_pose({.of = frames[of], .with_respect_to = frames[to], .avoid = std::move(avoid)})
        .latest(at_s(1));
  }
  // Which frames can be reached without some relations.
  std::vector<bool> reached_from(std::size_t from, const std::vector<RelationId>& avoid) const {
    std::vector<bool> reached(frames.size());
    reached[from] = true;
    for (bool more = true; more;) {
      more = false;
      for (const Link& link : relations) {
        if (std::find(avoid.begin(), avoid.end(), link.relation) != avoid.end()) continue;
        if (reached[link.of] == reached[link.to]) continue;
        reached[link.of] = reached[link.to] = more = true;
      }
    }
    return reached;
  }

  struct Link {
    RelationId relation;
    MeasurementId measurement;
    std::size_t of, to;
  };
  std::mt19937_64 random;
  World world;
  std::vector<FrameId> frames;
  std::vector<Pose> truth;
  std::vector<Link> relations;
};

TEST(BeyondTf2, AnyWayThroughAWebOfLoopsIsTheSamePose) {
  int answered = 0, cut_off = 0, several_parents = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    Web web(seed);
    std::map<std::size_t, int> parents;
    for (const Web::Link& link : web.relations) several_parents += ++parents[link.of] == 2;
    for (int i = 0; i < 40; ++i) {
      const std::size_t of = web.random() % web.frames.size(),
                        to = web.random() % web.frames.size();
      std::vector<RelationId> avoid;
      for (int k = static_cast<int>(web.random() % 20); k > 0; --k) {
        avoid.push_back(web.relations[web.random() % web.relations.size()].relation);
      }
      const PoseAnswer answer = web.ask(of, to, avoid);
      if (!web.reached_from(to, avoid)[of]) {
        EXPECT_EQ(answer.status, Status::kNotConnected);
        ++cut_off;
        continue;
      }
      ASSERT_EQ(answer.status, Status::kOk) << to_string(answer.status);
      EXPECT_LT(difference(answer.pose, web.X(of, to)), 1e-12);
      ++answered;
    }
  }
  EXPECT_GT(answered, 800);
  EXPECT_GT(cut_off, 20);
  EXPECT_GT(several_parents, 200);
}

TEST(BeyondTf2, AFrameWithTwoParentsKeepsBoth) {
  std::mt19937_64 random(2);
  World world;
  const FrameId part = world.add_frame("http://x/part"), left = world.add_frame("http://x/left"),
                right = world.add_frame("http://x/right");
  const auto see = [&](const char* name, FrameId from, const Pose& X) {
    const RelationId relation = world.add_relation(
        {.name = std::string("http://x/from-") + name, .of = part, .with_respect_to = from});
    world.write(
        world.add_measurement({.name = std::string("http://x/seen-") + name, .relation = relation}),
        at_s(1), X, {});
  };
  const Pose from_left = random_pose(random), from_right = random_pose(random);
  see("left", left, from_left);
  see("right", right, from_right);
  EXPECT_LT(difference(world.pose(part, left, at_s(1)).pose, from_left), 1e-15);
  EXPECT_LT(difference(world.pose(part, right, at_s(1)).pose, from_right), 1e-15);
  EXPECT_LT(
      difference(world.pose(right, left, at_s(1)).pose, compose(from_left, invert(from_right))),
      1e-14);
#ifdef SINEW_HAVE_TF2
  // In tf2 the second parent takes the place of the first.
  Tf2Buffer buffer;
  Tf2Numbers theirs;
  buffer.set("part", "left", 1'000'000'000, numbers(from_left));
  ASSERT_TRUE(buffer.lookup("left", "part", 0, &theirs));
  buffer.set("part", "right", 2'000'000'000, numbers(from_right));
  EXPECT_TRUE(buffer.lookup("right", "part", 0, &theirs));
  EXPECT_FALSE(buffer.lookup("left", "part", 0, &theirs));
#endif
}

// Random corrections and insertions; the oracle is a map from stamps to the last pose said of each.
TEST(BeyondTf2, ThePastIsWhatWasSaidOfItLast) {
  std::size_t corrected = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Web web(seed, 2, 1);
    const MeasurementId measured = web.relations[0].measurement;
    const std::size_t of = web.relations[0].of, to = web.relations[0].to;
    std::map<int, Pose> said;
    for (int i = 0; i < 60; ++i) {
      const int when = 10 + static_cast<int>(web.random() % 40);
      const Pose X = random_pose(web.random);
      corrected += said.contains(when) || (!said.empty() && when < said.rbegin()->first);
      ASSERT_EQ(web.world.write(measured, at_s(when), X, {}), Status::kOk);
      said[when] = X;
    }
    PreparedPose query =
        web.world.prepare_pose({.of = web.frames[of], .with_respect_to = web.frames[to]});
    for (const auto& [when, X] : said) {
      const PoseAnswer answer = query.at(at_s(when));
      ASSERT_EQ(answer.status, Status::kOk);
      EXPECT_LT(difference(answer.pose, X), 1e-15) << when;
    }
  }
  EXPECT_GT(corrected, 800u);
#ifdef SINEW_HAVE_TF2
  // What tf2 was told first of a stamp stays.
  std::mt19937_64 random(3);
  const Pose first = random_pose(random), second = random_pose(random);
  Tf2Buffer buffer;
  Tf2Numbers theirs;
  buffer.set("b", "a", 1'000'000'000, numbers(first));
  buffer.set("b", "a", 2'000'000'000, numbers(random_pose(random)));
  buffer.set("b", "a", 1'000'000'000, numbers(second));
  ASSERT_TRUE(buffer.lookup("a", "b", 1'000'000'000, &theirs));
  EXPECT_GT(difference(pose(theirs), second), 0.01);
#endif
}

TEST(BeyondTf2, ARemovedFrameIsGoneAndNothingElseIs) {
  int gone = 0, still = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Web web(seed);
    const std::size_t removed = web.random() % web.frames.size();
    std::vector<RelationId> lost;
    for (const Web::Link& link : web.relations) {
      if (link.of == removed || link.to == removed) lost.push_back(link.relation);
    }
    PreparedPose before = web.world.prepare_pose(
        {.of = web.frames[removed], .with_respect_to = web.frames[(removed + 1) % 12]});
    ASSERT_EQ(before.latest(at_s(1)).status, Status::kOk);
    web.world.remove(web.frames[removed]);
    EXPECT_EQ(before.latest(at_s(1)).status, Status::kRemoved);
    EXPECT_FALSE(web.world.find_frame("http://web/frame" + std::to_string(removed)));
    for (std::size_t of = 0; of < web.frames.size(); ++of) {
      for (std::size_t to = 0; to < web.frames.size(); ++to) {
        if (of == removed || to == removed) continue;
        const PoseAnswer answer = web.ask(of, to);
        if (!web.reached_from(to, lost)[of]) {
          EXPECT_EQ(answer.status, Status::kNotConnected);
          ++gone;
        } else {
          ASSERT_EQ(answer.status, Status::kOk);
          EXPECT_LT(difference(answer.pose, web.X(of, to)), 1e-12);
          ++still;
        }
      }
    }
    // The name is free for another.
    EXPECT_NO_THROW(web.world.add_frame("http://web/frame" + std::to_string(removed)));
  }
  EXPECT_GT(still, 1500);
  EXPECT_GT(gone, 10);
}

TEST(BeyondTf2, AClonesWhatIfIsItsOwn) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Web web(seed);
    World clone = web.world.clone();
    const std::vector<Pose> truth = web.truth;
    for (Pose& X : web.truth) X = random_pose(web.random);  // all has moved, in the clone alone
    for (const Web::Link& link : web.relations) {
      clone.write(link.measurement, at_s(2), web.X(link.of, link.to), {});
    }
    const auto in_original = [&](std::size_t of, std::size_t to) {
      return compose(invert(truth[to]), truth[of]);
    };
    for (std::size_t of = 0; of < web.frames.size(); ++of) {
      const PoseAnswer what_if = clone.pose(web.frames[of], web.frames[0], at_s(2));
      const PoseAnswer what_is = web.world.pose(web.frames[of], web.frames[0], at_s(2));
      EXPECT_LT(difference(what_if.pose, web.X(of, 0)), 1e-12);
      EXPECT_LT(difference(what_is.pose, in_original(of, 0)), 1e-12);
    }
  }
}

// A thing that turns and goes at a constant twist, seen ten times; then nobody looks any more.
TEST(BeyondTf2, AModelTellsWhatComesAfterTheLastEntry) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const Pose start = random_pose(random);
    const Twist V = {{normal(random), normal(random), normal(random)},
                     {normal(random), normal(random), normal(random)}};
    World world;
    const FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b");
    const RelationId relation =
        world.add_relation({.name = "http://x/r", .of = b, .with_respect_to = a});
    const MeasurementId seen = world.add_measurement(
        {.name = "http://x/seen",
         .relation = relation,
         .model = {.life_cycle = Prediction{.model = ConstantVelocity{},
                                            .horizon = std::chrono::seconds(3)}}});
#ifdef SINEW_HAVE_TF2
    Tf2Buffer buffer;
    Tf2Numbers theirs;
#endif
    for (int i = 0; i < 10; ++i) {
      const Pose X = compose(start, exponential(V, 0.1 * i));
      ASSERT_EQ(world.write(seen, at_s(1 + 0.1 * i), X, {}), Status::kOk);
#ifdef SINEW_HAVE_TF2
      buffer.set("b", "a", ns_of(at_s(1 + 0.1 * i)), numbers(X));
#endif
    }
    PreparedPose query = world.prepare_pose({.of = b, .with_respect_to = a});
    for (const double later : {1.95, 2.5, 4.0}) {
      const PoseAnswer answer = query.at(at_s(later));
      ASSERT_EQ(answer.status, Status::kOk);
      EXPECT_TRUE(answer.freshness.predicted);
      EXPECT_LT(difference(answer.pose, compose(start, exponential(V, later - 1))), 1e-9) << later;
#ifdef SINEW_HAVE_TF2
      EXPECT_FALSE(buffer.lookup("a", "b", ns_of(at_s(later)), &theirs));
#endif
    }
    EXPECT_EQ(query.at(at_s(4.95)).status, Status::kBeyondHorizon);
  }
}

}  // namespace
}  // namespace sinew::world
