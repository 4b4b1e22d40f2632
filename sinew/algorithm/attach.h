// Puts a robot around an algorithm: a `read` closure at the head of its schedule that fills the
// joint positions and velocities among its inputs, and a `write` closure at the end that takes the
// joint forces among its outputs. Everything else stays; the pure program is the same, byte for
// byte.
#pragma once

#include <string>
#include <vector>

#include "sinew/graph/store.h"

namespace sinew::algorithm {

struct RobotAttachment {
  std::string interface;  // IRI of the interface, "https://w3id.org/sinew/robot#mujoco"
  // What is commanded on a fault: one number for every joint force, or one number for all. It is
  // the user's to declare: there is no command that is safe for every robot.
  std::vector<double> safe;
};

// Throws Error: when the algorithm has such closures already, or neither reads nor commands a
// joint.
void attach_robot(graph::Store& store, graph::Id algorithm, const RobotAttachment& attachment);

// Whether there is a joint position or velocity among its inputs, or a joint force among its
// outputs.
bool speaks_of_joints(const graph::View& view, graph::Id algorithm);

// Whether it has a `read` or a `write` closure.
bool has_robot(const graph::View& view, graph::Id algorithm);

}  // namespace sinew::algorithm
