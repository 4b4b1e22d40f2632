// A world with every kind of relation, quantity, life-cycle and data block that a scene can say.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "sinew/blocks/elaborate.h"
#include "sinew/world/block_set.h"
#include "sinew/world/edit.h"
#include "sinew/world/world.h"
#include "times_and_places.h"

namespace sinew::world {

inline const std::string kBlockLibrary = std::string(kCanonicalPrototypes);

inline std::shared_ptr<const data::Library> block_library(const std::string& text) {
  return std::make_shared<const data::Library>(blocks::load_library(text, "blocks"));
}

struct Everything {
  Everything() {
    base = world.add_frame("http://x/base");
    arm = world.add_frame("http://x/arm");
    slide = world.add_frame("http://x/slide");
    part = world.add_frame("http://x/part");
    const Pose placed = {{0, 0, 0.38268343236508978, 0.92387953251128674}, {0.1, 0.2, 0.3}};
    elbow = world.add_relation({.name = "http://x/elbow",
                                .of = arm,
                                .with_respect_to = base,
                                .kind = RelationKind::kRevolute,
                                .placement = placed});
    rail = world.add_relation({.name = "http://x/rail",
                               .of = slide,
                               .with_respect_to = arm,
                               .kind = RelationKind::kPrismatic,
                               .placement = {{}, {0, 0, 1}}});
    lying = world.add_relation({.name = "http://x/lying", .of = part, .with_respect_to = slide});
    weight = world.add_relation({.name = "http://x/weight",
                                 .of = part,
                                 .with_respect_to = {},
                                 .kind = RelationKind::kProperty});
    const auto add = [&](const char* name, RelationId relation, Quantity quantity,
                         LifeCycle life_cycle, std::vector<double> values, std::uint32_t size = 0) {
      const MeasurementId made =
          world.add_measurement({.name = name,
                                 .relation = relation,
                                 .quantity = quantity,
                                 .model = {.life_cycle = std::move(life_cycle),
                                           .provenance = "http://x/driver",
                                           .used_by = {"http://x/task"}},
                                 .capacity = 100,
                                 .values = size});
      EXPECT_EQ(world.write(made, at_s(1.5), values, {"http://x/driver"}), Status::kOk) << name;
    };
    add("http://x/elbow/position", elbow, Quantity::kJointPosition,
        Prediction{ConstantVelocity{.twist = {}, .rates = {0.25}}, std::chrono::seconds(2)}, {0.7});
    add("http://x/elbow/velocity", elbow, Quantity::kJointVelocity,
        TimeDependent{.validity = std::chrono::milliseconds(20)}, {0.25});
    add("http://x/elbow/acceleration", elbow, Quantity::kJointAcceleration,
        TimeDependent{.validity = kForever, .expiry = at_s(100)}, {-0.5});
    add("http://x/rail/position", rail, Quantity::kJointPosition,
        Prediction{ConstantAcceleration{
                       .twist = {}, .twist_rate = {}, .rates = {0.1}, .accelerations = {0.2}},
                   std::chrono::seconds(3)},
        {0.4});
    add("http://x/lying/twist", lying, Quantity::kTwist, TimeDependent{}, {1, 2, 3, 4, 5, 6});
    add("http://x/lying/acceleration", lying, Quantity::kAcceleration, TimeDependent{},
        {6, 5, 4, 3, 2, 1});
    add("http://x/lying/pose", lying, Quantity::kPose,
        Prediction{ConstantAcceleration{.twist = {{0, 0, 1}, {1, 0, 0}},
                                        .twist_rate = {{0, 0, 0.5}, {0, 1, 0}},
                                        .rates = {},
                                        .accelerations = {}},
                   std::chrono::seconds(4)},
        {0, 0, 0, 1, 7, 8, 9});
    add("http://x/weight/scales", weight, Quantity::kOther, TimeDependent{}, {0.3, 0.01}, 2);
    const MeasurementId seen =
        world.add_measurement({.name = "http://x/seen",
                               .relation = lying,
                               .model = {.provenance = "http://x/camera"},
                               .keep_all = true,
                               .blocks = {.library = block_library(kBlockLibrary),
                                          .canonical = {},
                                          .blocks = {{"http://x/seen/a", kPosePrototype},
                                                     {"http://x/seen/b", kPosePrototype, true}},
                                          .library_text = kBlockLibrary}});
    world.write(seen, at_s(1), Pose{{}, {7, 8, 9}}, {"http://x/camera"});
    world.add_object("http://x/bolt", part, "http://x/bolts");
  }
  World world;
  FrameId base, arm, slide, part;
  RelationId elbow, rail, lying, weight;
};

}  // namespace sinew::world
