// Words for where things are, on a workbench in plain sight, and against formulas for boxes.
#include "sinew/world/qualitative.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "random_poses.h"
#include "refusal.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

constexpr WriteContext kCamera{"http://cell/camera"};

Pose turned(double angle_rad, const Vector3& p) { return {revolute(angle_rad).q, p}; }

struct Bench {
  World world;
  FrameId floor = world.add_frame("http://cell/floor");
  Space space{world, floor};

  BodyId body(const std::string& name, const Pose& pose, const Geometry& geometry) {
    const std::string iri = "http://cell/" + name;
    const FrameId frame = world.add_frame(iri);
    world.add_static(iri + "-pose", frame, floor, pose, "http://cell/configuration");
    return space.add(frame, {{geometry, {}}});
  }
  // The table's top is at 0.8 m; the cup stands on it, 0.1 m high.
  BodyId table = body("table", translation(0, 0, 0.775), Box{{1.2, 0.8, 0.05}});
  BodyId cup = body("cup", translation(0.2, 0.1, 0.85), Cylinder{0.04, 0.1});
  BodyId lamp = body("lamp", translation(0.2, 0, 1.6), Sphere{0.1});
  BodyId crate = body("crate", translation(0.2, 0.1, 0.9), Box{{0.3, 0.3, 0.25}});
  BodyId beside = body("beside", translation(0.9, 0, 0.85), Box{{0.1, 0.1, 0.1}});
};

struct Case {
  const char* relation;
  BodyId Bench::*first;
  BodyId Bench::*second;
  bool holds;
};

TEST(Relations, HoldOnAWorkbenchAsOneWouldSay) {
  Bench b;
  b.space.update(at_s(0));
  const Relations relations(b.space);
  const Case cases[] = {
      {"on", &Bench::cup, &Bench::table, true},
      {"on", &Bench::table, &Bench::cup, false},
      {"on", &Bench::lamp, &Bench::table, false},
      {"on", &Bench::beside, &Bench::table, false},  // at the right height, over nothing
      {"above", &Bench::lamp, &Bench::table, true},
      {"above", &Bench::cup, &Bench::table, false},
      {"above", &Bench::table, &Bench::lamp, false},
      {"in", &Bench::cup, &Bench::crate, true},
      {"in", &Bench::crate, &Bench::cup, false},
      {"in", &Bench::lamp, &Bench::crate, false},
      {"near", &Bench::beside, &Bench::table, true},
      {"near", &Bench::lamp, &Bench::table, false},
      {"in-front-of", &Bench::beside, &Bench::table, true},
      {"in-front-of", &Bench::crate, &Bench::cup, false},  // the cup is in it
      {"in-front-of", &Bench::cup, &Bench::table, false},  // it is on it
  };
  for (const Case& c : cases) {
    const Judgement judgement =
        relations.judge({.relation = c.relation, .first = b.*c.first, .second = b.*c.second});
    ASSERT_EQ(judgement.status, Status::kOk);
    EXPECT_EQ(judgement.holds, c.holds) << explain(judgement);
  }
}

TEST(Relations, AreExplainedByTheNumbersThatMadeThemTrue) {
  Bench b;
  b.space.update(at_s(0));
  const Relations relations(b.space);
  const Judgement on = relations.judge({.relation = "on", .first = b.cup, .second = b.table});
  ASSERT_EQ(on.findings.size(), 2u);
  EXPECT_EQ(on.findings[0].quantity, "height-gap");
  EXPECT_EQ(on.findings[0].unit, "m");
  EXPECT_NEAR(on.findings[0].value, 0, 1e-12);
  EXPECT_NEAR(on.findings[1].value, 1, 1e-12);
  const Judgement no = relations.judge({.relation = "on", .first = b.lamp, .second = b.table});
  EXPECT_EQ(explain(no),
            "http://cell/lamp on http://cell/table: false, along the axes of http://cell/floor; "
            "height-gap 0.7 m is not within -0.005 .. 0.02; covered-share 1 1 is within 0.3 .. 1");
}

// A car that looks along its own x; a thing at its left, seen by somebody who faces the car.
TEST(Relations, OfSidesDependOnTheNamedFrame) {
  Bench b;
  for (const double heading : {0.0, 1.0, 2.5, -2.0}) {
    Bench scene;
    const Pose car_pose = turned(heading, {3, -2, 0});
    const BodyId car = scene.body("car", car_pose, Box{{0.5, 0.3, 0.3}});
    const auto at = [&](const char* name, double x, double y) {
      return scene.body(name, compose(car_pose, translation(x, y, 0)), Sphere{0.1});
    };
    const BodyId front = at("front", 1, 0.2), left = at("left", -0.2, 1), back = at("back", -1, 0),
                 right = at("right", 0, -1);
    const FrameId viewer = scene.world.add_frame("http://cell/viewer");
    scene.world.add_static("http://cell/viewer-pose", viewer, scene.floor,
                           compose(car_pose, turned(std::numbers::pi, {4, 0, 0})), "http://cell/x");
    scene.space.update(at_s(0));
    const Relations relations(scene.space);
    const auto only = [&](const char* relation, BodyId expected) {
      for (const BodyId body : {front, left, back, right}) {
        const Judgement judgement =
            relations.judge({.relation = relation, .first = body, .second = car, .viewer = viewer});
        EXPECT_EQ(judgement.holds, body == expected) << explain(judgement);
      }
    };
    only("in-front-of", front);
    only("left-of", left);
    only("right-of", right);
    only("behind", back);
    only("in-front-of-as-seen", front);  // the viewer stands there
    only("left-of-as-seen", right);
    only("right-of-as-seen", left);
    EXPECT_EQ(relations.judge({.relation = "left-of", .first = left, .second = car}).axes,
              "http://cell/car");
  }
}

TEST(Relations, BetweenAsksForThree) {
  Bench b;
  const BodyId middle = b.body("middle", translation(0.55, 0, 0.85), Sphere{0.02});
  b.space.update(at_s(0));
  const Relations relations(b.space);
  const auto holds = [&](BodyId first, BodyId second, BodyId third) {
    return relations
        .judge({.relation = "between", .first = first, .second = second, .third = third})
        .holds;
  };
  EXPECT_TRUE(holds(middle, b.cup, b.beside));
  EXPECT_TRUE(holds(middle, b.beside, b.cup));
  EXPECT_FALSE(holds(b.cup, middle, b.beside));
  EXPECT_FALSE(holds(b.lamp, b.cup, b.beside));
  EXPECT_NE(refusal([&] {
              relations.judge({.relation = "between", .first = middle, .second = b.cup});
            }).find("a body too few"),
            std::string::npos);
}

TEST(Relations, ReachableIsWithinTheDeclaredReach) {
  Bench b;
  const BodyId robot = b.body("robot", translation(-0.4, 0.1, 0.85), Cylinder{0.1, 0.1});
  b.space.update(at_s(0));
  Relations relations(b.space);
  const Question question = {.relation = "reachable", .first = b.cup, .second = robot};
  EXPECT_NE(refusal([&] { relations.judge(question); }).find("no declared 'reach'"),
            std::string::npos);
  relations.declare(robot, "reach", 0.57);
  EXPECT_TRUE(relations.judge(question).holds);  // 0.6 m to the cup's axis, 0.04 m its radius
  relations.declare(robot, "reach", 0.55);
  const Judgement judgement = relations.judge(question);
  EXPECT_FALSE(judgement.holds);
  EXPECT_NEAR(judgement.findings[0].value, 0.56, 1e-6);
}

TEST(Relations, AreFoundForEveryBodyAndFollowWhatMoves) {
  Bench b;
  const FrameId frame = b.world.add_frame("http://cell/ball");
  const RelationId pose = b.world.add_relation(
      {.name = "http://cell/ball-pose", .of = frame, .with_respect_to = b.floor});
  const MeasurementId seen =
      b.world.add_measurement({.name = "http://cell/seen",
                               .relation = pose,
                               .model = {.provenance = "http://cell/camera"}});
  const BodyId ball = b.space.add(frame, {{Sphere{0.05}, {}}});
  const Relations relations(b.space);
  const auto on_table = [&] { return relations.find({.relation = "on", .second = b.table}); };

  b.space.update(at_s(0));
  EXPECT_EQ(on_table().unplaced, std::vector<BodyId>{ball});
  const Judgement unknown = relations.judge({.relation = "on", .first = ball, .second = b.table});
  EXPECT_EQ(unknown.status, Status::kNoData);
  EXPECT_NE(explain(unknown).find("not known"), std::string::npos);

  b.world.write(seen, at_s(1), translation(-0.3, 0, 0.851), kCamera);
  b.space.update(at_s(1));
  const auto found = on_table();
  ASSERT_EQ(found.bodies.size(), 2u);
  EXPECT_EQ(found.bodies[0].first, b.cup);
  EXPECT_EQ(found.bodies[1].first, ball);
  EXPECT_TRUE(found.unplaced.empty());

  b.world.write(seen, at_s(2), translation(-0.3, 0, 1.2), kCamera);
  b.space.update(at_s(2));
  EXPECT_EQ(on_table().bodies.size(), 1u);
}

// The oracle: formulas for boxes along the axes, written here.
TEST(Relations, OfRandomBoxesAreAsTheirIntervalsSay) {
  std::mt19937_64 random(15);
  std::uniform_real_distribution<double> at(-0.5, 0.5), size(0.1, 0.8);
  int on = 0, above = 0, in = 0, near = 0;
  for (int scene = 0; scene < 40; ++scene) {
    Bench b;
    struct Known {
      BodyId body;
      Vector3 p, half;
    };
    std::vector<Known> boxes;
    for (int i = 0; i < 12; ++i) {
      const Vector3 s = {size(random), size(random), size(random)};
      Vector3 p = {at(random), at(random), 2 * at(random)};
      if (i % 3 == 0 && i > 0) p.z = boxes[0].p.z + boxes[0].half.z + s.z / 2 + 0.02 * at(random);
      const Vector3 shown = i % 4 == 1 ? 0.2 * s : s;
      boxes.push_back({b.body("box" + std::to_string(i), {{}, p}, Box{shown}), p, 0.5 * shown});
    }
    b.space.update(at_s(0));
    const Relations relations(b.space);
    for (const Known& i : boxes) {
      for (const Known& k : boxes) {
        if (i.body == k.body) continue;
        const double gap = (i.p.z - i.half.z) - (k.p.z + k.half.z);
        const auto shared = [](double p, double h, double q, double g) {
          return std::max(0.0, std::min(p + h, q + g) - std::max(p - h, q - g));
        };
        const double share = shared(i.p.x, i.half.x, k.p.x, k.half.x) *
                             shared(i.p.y, i.half.y, k.p.y, k.half.y) / (4 * i.half.x * i.half.y);
        const auto over = [](double p, double h, double q, double g) {
          return std::abs(p - q) + h - g;
        };
        const double outside = std::max({over(i.p.x, i.half.x, k.p.x, k.half.x),
                                         over(i.p.y, i.half.y, k.p.y, k.half.y),
                                         over(i.p.z, i.half.z, k.p.z, k.half.z)});
        const auto apart = [](double p, double h, double q, double g) {
          return std::max(0.0, std::abs(p - q) - h - g);
        };
        const double distance = std::hypot(apart(i.p.x, i.half.x, k.p.x, k.half.x),
                                           apart(i.p.y, i.half.y, k.p.y, k.half.y),
                                           apart(i.p.z, i.half.z, k.p.z, k.half.z));
        const auto check = [&](const char* relation, bool expected, int& count) {
          const Judgement judgement =
              relations.judge({.relation = relation, .first = i.body, .second = k.body});
          EXPECT_EQ(judgement.holds, expected) << explain(judgement);
          count += expected;
        };
        check("on", gap >= -0.005 && gap <= 0.02 && share >= 0.3, on);
        check("above", gap >= 0.02 && share >= 0.1, above);
        check("in", outside <= 0.005, in);
        check("near", distance <= 0.3, near);
      }
    }
  }
  EXPECT_GT(std::min({on, above, in, near}), 5) << on << " " << above << " " << in << " " << near;
}

TEST(Relations, RulesAreDataThatOneMayExchange) {
  Bench b;
  b.space.update(at_s(0));
  const Relations relations(b.space,
                            {{.name = "within-arm-length",
                              .conditions = {{"distance", 0, 0.9}, {"up-offset", -0.5, 0.5}}}});
  EXPECT_TRUE(
      relations.judge({.relation = "within-arm-length", .first = b.beside, .second = b.cup}).holds);
  EXPECT_FALSE(
      relations.judge({.relation = "within-arm-length", .first = b.lamp, .second = b.cup}).holds);
  EXPECT_NE(refusal([&] {
              relations.judge({.relation = "on", .first = b.cup, .second = b.table});
            }).find("no relation that a rule is declared for"),
            std::string::npos);
}

TEST(Relations, RefuseRulesThatCannotBeMeasured) {
  Bench b;
  const auto refused = [&](std::vector<Rule> rules) {
    return refusal([&] { Relations(b.space, std::move(rules)); });
  };
  EXPECT_NE(refused({{.name = "on", .conditions = {{"hight-gap", 0, 1}}}})
                .find("no quantity 'hight-gap'"),
            std::string::npos);
  EXPECT_NE(refused({{.name = "on", .conditions = {{"height-gap", 1, 0}}}}).find("not in order"),
            std::string::npos);
  EXPECT_NE(refused({{.name = "on", .conditions = {{"height-gap", NAN, 0}}}}).find("not in order"),
            std::string::npos);
  EXPECT_NE(refused({{.name = "on", .conditions = {{"off-the-way", 0, 1}}}}).find("three bodies"),
            std::string::npos);
  EXPECT_NE(refused({{.name = "on", .conditions = {}}}).find("no condition"), std::string::npos);
  EXPECT_NE(
      refused({{.name = "on", .conditions = {{"distance", 0, 1, "reach"}}}}).find("stated twice"),
      std::string::npos);
  const Rule rule = {.name = "on", .conditions = {{"distance", 0, 1}}};
  EXPECT_NE(refused({rule, rule}).find("two rules"), std::string::npos);
}

}  // namespace
}  // namespace sinew::world
