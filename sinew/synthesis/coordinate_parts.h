// What handing numbers out to the joints of the tree (coordinates.cpp) and gathering them again
// (results.cpp) have in common.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "sinew/synthesis/coordinates.h"

namespace sinew::synthesis {

// Closures that are made while one lives are of the step "joint-coordinates".
class AsCoordinateStep {
 public:
  explicit AsCoordinateStep(Context& context);
  ~AsCoordinateStep();
  AsCoordinateStep(const AsCoordinateStep&) = delete;
  AsCoordinateStep& operator=(const AsCoordinateStep&) = delete;

 private:
  Context& context_;
  const Step* before_;
};

// Null where the coordinate is a joint of the tree.
const RobotCompound* compound_of(const Context& context, const Coordinate& coordinate);

std::vector<std::size_t> followers(const Robot& robot, std::size_t leader);

// A coordinate matters where one of its parts does, or a joint that follows one.
bool in_scope(const Context& context, const RobotJoint& joint);
bool in_scope(const Context& context, const Coordinate& coordinate);

// How `target`'s number follows from others: a factor for each, and what is added.
BlockIndex make_map(Context& context, const algorithm::BlockSpec& target,
                    std::span<const double> factors, double offset);

// The block of all numbers of a joint with several degrees of freedom.
BlockIndex make_numbers(Context& context, const Coordinate& coordinate, std::string_view slot,
                        std::string_view what, algorithm::Role role);

}  // namespace sinew::synthesis
