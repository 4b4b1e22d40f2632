// A robot in the world: the frames and joints of a normalised kinematic tree become frames and
// relations, its joint positions measurements. Poses across the robot are then answered like any
// others, by forward kinematics in the graph.
#pragma once

#include <string>
#include <vector>

#include "sinew/graph/terms.h"
#include "sinew/model/tree.h"
#include "sinew/world/world.h"

namespace sinew::world {

struct RobotSpec {
  std::string provenance;                  // who provides the joints' measurements
  bool velocities = false;                 // measured as well: twists can be asked
  bool accelerations = false;              // the same for accelerations
  LifeCycle life_cycle = TimeDependent{};  // of the joints' measurements
  Duration period = kForever;
  std::uint32_t capacity = kUsualCapacity;
};

// In the tree's order of joints.
struct RobotInWorld {
  FrameId root;
  std::vector<RelationId> joints;
  std::vector<MeasurementId> positions, velocities, accelerations;
};

// One edit: every frame of the tree (those that are there already by their IRI are used), a static
// relation for each that is fixed to a body, a relation named by the joint's IRI for each joint,
// and measurements JOINT/position, JOINT/velocity, JOINT/acceleration.
RobotInWorld add_robot(World& world, const model::Tree& tree, const graph::Terms& terms,
                       const RobotSpec& spec);

}  // namespace sinew::world
