#include "sinew/robot/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sinew/base/error.h"

namespace sinew::robot {
namespace {

TEST(Scene, SaysWhatIsThere) {
  const Scene scene = parse_scene(R"({
    "start": { "position.joint2": 0.3 }, "joint-damping": 0.1,
    "tool": { "frame": "flange", "radius": 0.04 },
    "table": { "center": [0.5, 0, 0.2], "size": [0.4, 0.6, 0.05] },
    "object": { "frame": "flange", "mass": 1, "center-of-mass": [0, 0, -0.1],
                "inertia": [0.002, 0.002, 0.002] },
    "hand": { "frame": "flange", "stiffness": 2000, "damping": 100, "maximum-force": 80,
              "phases": [ { "name": "free", "until": 2 },
                          { "name": "down", "until": 5, "velocity": [0, 0, -0.15] },
                          { "name": "up", "until": 7, "force": [0, 0, 20] } ] } })",
                                  "scene.json");
  EXPECT_EQ(scene.start.at("position.joint2"), 0.3);
  EXPECT_EQ(scene.table->size[1], 0.6);
  EXPECT_EQ(scene.object->mass, 1);
  ASSERT_EQ(scene.hand->phases.size(), 3u);
  EXPECT_FALSE(scene.hand->phases[0].velocity.has_value());
  EXPECT_EQ((*scene.hand->phases[1].velocity)[2], -0.15);
  EXPECT_EQ((*scene.hand->phases[2].force)[2], 20);
}

struct Fault {
  const char* json;
  const char* expected;
};

TEST(Scene, IsRefusedWithTheReason) {
  const Fault faults[] = {
      {"[", "scene: "},
      {"[]", "is no object"},
      {R"({"tabel": {}})", "'tabel' is unknown"},
      {R"({"tool": {"frame": "f"}})", "has no 'radius'"},
      {R"({"tool": {"frame": "f", "radius": 0}})", "is not positive"},
      {R"({"tool": {"frame": 3, "radius": 1}})", "is no text"},
      {R"({"table": {"center": [0,0,0], "size": [1,1,1]}})", "nothing can touch it"},
      {R"({"start": {"position.joint1": "far"}})", "is no number"},
      {R"({"object": {"frame": "f", "mass": -1, "center-of-mass": [0,0,0],
           "inertia": [1,1,1]}})",
       "object: mass: is not positive"},
      {R"({"object": {"frame": "f", "mass": 1, "center-of-mass": [0,0], "inertia": [1,1,1]}})",
       "is no vector"},
      {R"({"hand": {"frame": "f", "stiffness": 1, "damping": 1, "maximum-force": 1,
           "phases": [{"name": "a", "until": 2}, {"name": "b", "until": 1}]}})",
       "phase 2: ends before it begins"},
      {R"({"hand": {"frame": "f", "stiffness": 1, "damping": 1, "maximum-force": 1,
           "phases": [{"name": "a", "until": 2, "force": [0,0,0], "velocity": [0,0,0]}]}})",
       "guides or pushes"},
  };
  for (const Fault& fault : faults) {
    try {
      parse_scene(fault.json, "scene.json");
      ADD_FAILURE() << fault.json;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(fault.expected)) << fault.json;
      EXPECT_THAT(error.what(), testing::HasSubstr("scene.json"));
    }
  }
}

}  // namespace
}  // namespace sinew::robot
