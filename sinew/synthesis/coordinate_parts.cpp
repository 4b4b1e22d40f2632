#include "sinew/synthesis/coordinate_parts.h"

#include <algorithm>

#include "sinew/synthesis/free_joint.h"

namespace sinew::synthesis {

using algorithm::BlockSpec;
using algorithm::Role;

namespace {

const Step kCoordinates = {.name = "joint-coordinates",
                           .purpose = "joints of the tree from the coordinates, and back",
                           .expansion = {},
                           .needs = {},
                           .may_use = {},
                           .gives = {},
                           .visitors = {}};

std::string plural(std::string_view slot) {
  return slot == "velocity" ? "joint-velocities" : "joint-" + std::string(slot) + "s";
}

}  // namespace

AsCoordinateStep::AsCoordinateStep(Context& context) : context_(context), before_(context.step) {
  context.step = &kCoordinates;
}

AsCoordinateStep::~AsCoordinateStep() { context_.step = before_; }

const RobotCompound* compound_of(const Context& context, const Coordinate& coordinate) {
  return coordinate.compound < 0
             ? nullptr
             : &context.robot.compounds[static_cast<std::size_t>(coordinate.compound)];
}

std::vector<std::size_t> followers(const Robot& robot, std::size_t leader) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < robot.joints.size(); ++k)
    if (robot.joints[k].follows == static_cast<int>(leader)) found.push_back(k);
  return found;
}

bool in_scope(const Context& context, const RobotJoint& joint) {
  return context.scope.empty() || context.scope.contains(joint.frame);
}

bool in_scope(const Context& context, const Coordinate& coordinate) {
  const auto& joints = context.robot.joints;
  return std::any_of(coordinate.parts.begin(), coordinate.parts.end(), [&](std::size_t part) {
    if (in_scope(context, joints[part])) return true;
    const auto behind = followers(context.robot, part);
    return std::any_of(behind.begin(), behind.end(),
                       [&](std::size_t k) { return in_scope(context, joints[k]); });
  });
}

BlockIndex make_map(Context& context, const BlockSpec& target, std::span<const double> factors,
                    double offset) {
  std::vector<double> value = {static_cast<double>(factors.size())};
  value.insert(value.end(), factors.begin(), factors.end());
  value.push_back(offset);
  const std::string slot = std::string(target.slot) + "-map";
  BlockSpec map = target;
  map.slot = slot;
  map.quantity = "coordinate-map";
  map.role = Role::kConstant;
  map.size = static_cast<std::uint32_t>(value.size());
  map.prismatic = false;
  map.unit = {};
  map.value = value;
  return context.make(map);
}

BlockIndex make_numbers(Context& context, const Coordinate& coordinate, std::string_view slot,
                        std::string_view what, Role role) {
  const RobotCompound& compound = *compound_of(context, coordinate);
  const std::string quantity = plural(what);
  BlockSpec spec = whole_quantity(context, compound, what);
  spec.slot = slot;
  spec.role = role;
  if (!compound.is_free() || what == "force") {
    spec.quantity = quantity;
    spec.size = static_cast<std::uint32_t>(coordinate.parts.size());
  }
  return context.make(spec);
}

}  // namespace sinew::synthesis
