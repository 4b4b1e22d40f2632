// The joints of a robot in the order of its model, as channels of an interface: positions first,
// then velocities; and forces.
#pragma once

#include <string>
#include <vector>

#include "sinew/graph/terms.h"
#include "sinew/model/tree.h"
#include "sinew/runtime/robot_interface.h"

namespace sinew::robot {

struct Joint {
  std::string iri;
  std::string name;            // its last segment
  double maximum_force = 0.0;  // N m or N; infinity where the model states none
};

class Joints {
 public:
  Joints(const model::Tree& tree, const graph::Terms& terms);

  std::size_t size() const { return joints_.size(); }
  const Joint& operator[](std::size_t i) const { return joints_[i]; }

  // joint-position: i; joint-velocity: size() + i. Throws Error for any other block.
  runtime::Channel measurement(const program::Variable& block) const;
  // joint-force: i. Throws Error for any other block.
  runtime::Channel command(const program::Variable& block) const;
  // By name or IRI; throws Error.
  std::size_t find(const std::string& name) const;

 private:
  std::size_t of(const program::Variable& block) const;
  std::vector<Joint> joints_;
};

}  // namespace sinew::robot
