// The controller that holds a pose: for each joint, the acceleration of a critically damped spring.
#pragma once

#include "sinew/graph/store.h"
#include "sinew/model/tree.h"

namespace sinew::examples {

struct HoldGains {
  double stiffness = 100;  // k [1/s^2]
  double damping = 20;     // d [1/s]; 2 sqrt(k) is critical
};

// Writes the algorithm: acceleration.JOINT = k (reference.JOINT - position.JOINT) - d
// velocity.JOINT. Inputs are the joints' positions, velocities and references. Returns its node.
graph::Id write_hold(graph::Store& store, const model::Tree& tree, const HoldGains& gains);

}  // namespace sinew::examples
