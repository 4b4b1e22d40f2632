// A URDF robot's collision geometry as shapes of its frames: they move with the joints, and are
// found in regions.
#include "sinew/world/robot_shapes.h"

#include <gtest/gtest.h>

#include "sinew/model/load.h"
#include "sinew/model/normalise.h"
#include "sinew/model/urdf.h"
#include "sinew/world/robot.h"
#include "sinew/world/space.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

const char* const kRobot = R"(<robot name="arm">
 <link name="base"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
 <link name="boom">
  <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/><geometry><box size="0.2 2 0.2"/></geometry></collision>
  <collision><origin xyz="2 0 0"/><geometry><sphere radius="0.3"/></geometry></collision>
  <collision><geometry><mesh filename="package://arm/boom.stl"/></geometry></collision>
 </link>
 <joint name="turn" type="revolute"><parent link="base"/><child link="boom"/>
  <origin xyz="0 0 1"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>)";

TEST(RobotShapes, MoveWithTheJointsAndAreFound) {
  graph::Store store;
  graph::Places places;
  Report report;
  const model::Source source{"arm.urdf", kRobot};
  model::load({&source, 1}, {}, store, places, report);
  report.throw_if_errors();
  const model::Tree tree = model::normalise(store, places, {}, report);
  report.throw_if_errors();
  World world;
  const RobotInWorld robot =
      add_robot(world, tree, store.terms(), {.provenance = "http://x/driver"});
  Report shapes_report;
  const auto bodies = read_robot_shapes(world, store, places, shapes_report);
  // The mesh has no file here: named, and left out.
  ASSERT_EQ(shapes_report.problems().size(), 1u);
  EXPECT_EQ(shapes_report.problems()[0].severity, Severity::kWarning);
  EXPECT_NE(to_string(shapes_report.problems()[0]).find("package 'arm'"), std::string::npos);
  EXPECT_TRUE(to_string(shapes_report.problems()[0]).starts_with("arm.urdf:"));
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_EQ(bodies[0].shapes.size(), 2u);

  Space space(world, robot.root);
  DeclaredScene scene;
  scene.bodies = bodies;
  add_bodies(space, scene);
  // The box lies along x of the link, from 0 to 2 m, one metre up; the sphere is at its end.
  const std::vector<Shape> ahead = {{Sphere{0.05}, {{}, {2.2, 0, 1}}}},
                           beside = {{Sphere{0.05}, {{}, {0, 1.5, 1}}}};
  for (const double q : {0.0, 1.5707963267948966}) {
    const double position[] = {q};
    world.write(robot.positions[0], at_s(q > 0 ? 2 : 1), position, {"http://x/driver"});
    space.update(at_s(2));
    EXPECT_EQ(space.within(robot.root, ahead, Match::kTouching).bodies.size(), q > 0 ? 0u : 1u);
    EXPECT_EQ(space.within(robot.root, beside, Match::kTouching).bodies.size(), q > 0 ? 1u : 0u);
  }
}

}  // namespace
}  // namespace sinew::world
