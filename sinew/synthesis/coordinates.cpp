#include "sinew/synthesis/coordinates.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/error.h"
#include "sinew/synthesis/drivers.h"
#include "sinew/synthesis/free_joint.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::Role;

const Step kCoordinates = {.name = "joint-coordinates",
                           .purpose = "joints of the tree from the coordinates, and back",
                           .expansion = {},
                           .needs = {},
                           .may_use = {},
                           .gives = {},
                           .visitors = {}};

// Closures that are made in here are of this step.
class AsStep {
 public:
  explicit AsStep(Context& context) : context_(context), before_(context.step) {
    context.step = &kCoordinates;
  }
  ~AsStep() { context_.step = before_; }
  AsStep(const AsStep&) = delete;
  AsStep& operator=(const AsStep&) = delete;

 private:
  Context& context_;
  const Step* before_;
};

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

// A coordinate matters where one of its parts does, or a joint that follows one.
bool in_scope(const Context& context, const Coordinate& coordinate) {
  const auto& joints = context.robot.joints;
  return std::any_of(coordinate.parts.begin(), coordinate.parts.end(), [&](std::size_t part) {
    if (in_scope(context, joints[part])) return true;
    const auto behind = followers(context.robot, part);
    return std::any_of(behind.begin(), behind.end(),
                       [&](std::size_t k) { return in_scope(context, joints[k]); });
  });
}

// How `target`'s number follows from others: a factor for each, and what is added.
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

std::string plural(std::string_view slot) {
  return slot == "velocity" ? "joint-velocities" : "joint-" + std::string(slot) + "s";
}

// The block of all numbers of a joint with several degrees of freedom.
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

// A joint of the tree from the numbers of the model's joint that it is a part of.
void take_parts(Context& context, const Coordinate& coordinate, std::string_view slot,
                BlockIndex numbers) {
  for (std::size_t k = 0; k < coordinate.parts.size(); ++k) {
    const RobotJoint& part = context.robot.joints[coordinate.parts[k]];
    BlockSpec target = joint_quantity(slot, part);
    std::vector<double> factors(coordinate.parts.size(), 0.0);
    factors[k] = 1;
    const BlockIndex map = make_map(context, target, factors, 0);
    context.closure(std::string(slot) + "-of-part", {numbers, map, context.make(target)},
                    part.joint);
  }
}

void lead(Context& context, std::size_t leader, std::string_view slot) {
  const auto& joints = context.robot.joints;
  for (const std::size_t k : followers(context.robot, leader)) {
    BlockSpec target = joint_quantity(slot, joints[k]);
    const double factor[] = {joints[k].ratio};
    const BlockIndex map =
        make_map(context, target, factor, slot == "position" ? joints[k].offset : 0);
    context.closure(std::string(slot) + "-from-leader",
                    {context.block(slot, joints[leader].joint), map, context.make(target)},
                    joints[k].joint);
  }
}

}  // namespace

namespace {

// A force on a joint and on those that follow it, where there is one; `element(k)` is what it
// belongs to of joint k.
template <typename Element>
BlockIndex add_coupled(Context& context, std::string_view slot, std::size_t part,
                       Element&& element) {
  const auto& joints = context.robot.joints;
  std::vector<BlockIndex> blocks;
  std::vector<double> factors;
  const auto add = [&](std::size_t k, double factor) {
    const BlockIndex block = context.board.find(slot, element(k));
    if (block == algorithm::kNoIndex) return;
    blocks.push_back(block);
    factors.push_back(factor);
  };
  add(part, 1);
  for (const std::size_t k : followers(context.robot, part)) add(k, joints[k].ratio);
  if (blocks.empty()) return context.block(slot, element(part));
  if (blocks.size() == 1 && factors.front() == 1) return blocks.front();
  const std::string own_slot = "coupled-" + std::string(slot);
  BlockSpec target = joint_quantity("force", joints[part]);
  target.slot = own_slot;
  target.represents = element(part);
  const auto count = static_cast<std::uint32_t>(blocks.size());
  blocks.push_back(make_map(context, target, factors, 0));
  blocks.push_back(context.make(target));
  const BlockIndex made = blocks.back();
  context.closure_with_counts("force-of-coupled", std::move(blocks), {count, 1, 1},
                              joints[part].joint);
  return made;
}

}  // namespace

BlockIndex coupled_force(Context& context, std::string_view slot, std::size_t part) {
  const AsStep step(context);
  return add_coupled(context, slot, part,
                     [&](std::size_t k) { return context.robot.joints[k].joint; });
}

namespace {

// The share that a wrench from outside has in a coordinate's force. `pair` stands for the joint and
// the frame on which the wrench acts.
BlockIndex coupled_share(Context& context, Id pair) {
  const AsStep step(context);
  const auto& joints = context.robot.joints;
  for (std::size_t part = 0; part < joints.size(); ++part)
    for (const ExternalWrench& one : context.wrenches)
      if (context.pair(joints[part].joint, one.frame) == pair) {
        const BlockIndex share = add_coupled(context, "force-share", part, [&](std::size_t k) {
          return context.pair(joints[k].joint, one.frame);
        });
        if (share != context.board.find("force-share", pair))
          context.builder.rename(
              share,
              fmt::format("force-share.{}.{}",
                          algorithm::short_name(context.view.terms().text(joints[part].joint)),
                          one.label));
        return share;
      }
  return context.block("force-share", pair);
}

}  // namespace

void take_all(Context& context, std::string_view slot, BlockIndex numbers) {
  const AsStep step(context);
  const auto& joints = context.robot.joints;
  std::size_t width = 0, at = 0;
  for (const Coordinate& coordinate : coordinates(context.robot))
    for (const std::size_t part : coordinate.parts)
      width += joints[part].kind == "floating" ? 6 : 1;
  for (const Coordinate& coordinate : coordinates(context.robot)) {
    for (const std::size_t part : coordinate.parts) {
      BlockSpec target = joint_quantity(slot, joints[part]);
      const bool floats = joints[part].kind == "floating";
      std::vector<double> factors(width, 0.0);
      factors[at] = 1;
      at += floats ? 6 : 1;
      const BlockIndex map = make_map(context, target, factors, 0);
      context.closure(
          floats ? "floating-" + std::string(slot) + "-of-robot" : std::string(slot) + "-of-part",
          {numbers, map, context.make(target)}, joints[part].joint);
      lead(context, part, slot);
    }
  }
}

namespace {

// Columns are joints of the tree where they matter; coordinates have fewer.
std::vector<double> coupling(const Context& context, bool with_rotors) {
  const auto& joints = context.robot.joints;
  std::vector<std::size_t> rows;  // joints, one entry for each number
  for (std::size_t k = 0; k < joints.size(); ++k)
    if (in_scope(context, joints[k]))
      rows.insert(rows.end(), joints[k].kind == "floating" ? 6 : 1, k);
  std::vector<std::size_t> columns;
  for (const Coordinate& coordinate : coordinates(context.robot))
    if (in_scope(context, coordinate))
      for (const std::size_t part : coordinate.parts)
        columns.insert(columns.end(), joints[part].kind == "floating" ? 6 : 1, part);
  std::vector<double> map = {static_cast<double>(rows.size()), static_cast<double>(columns.size())};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const RobotJoint& row = joints[rows[r]];
    const auto leader = row.follows >= 0 ? static_cast<std::size_t>(row.follows) : rows[r];
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const bool same = columns[c] == leader && (row.kind != "floating" || r == c);
      map.push_back(same ? (row.follows >= 0 ? row.ratio : 1) : 0);
    }
  }
  if (with_rotors)
    for (const std::size_t k : rows) map.push_back(joints[k].rotor_inertia);
  return map;
}

std::string_view coupling_operator(std::string_view quantity) {
  for (const auto& [name, operation] :
       {std::pair<std::string_view, std::string_view>{"mass-matrix", "couple-mass-matrix"},
        {"jacobian", "couple-jacobian"},
        {"analytic-jacobian", "couple-analytic-jacobian"},
        {"linear-jacobian", "couple-linear-jacobian"},
        {"momentum-matrix", "couple-momentum-matrix"}})
    if (name == quantity) return operation;
  return {};
}

bool has_rotors(const Robot& robot) {
  return std::any_of(robot.joints.begin(), robot.joints.end(),
                     [](const RobotJoint& joint) { return joint.rotor_inertia != 0; });
}

}  // namespace

std::vector<Coordinate> coordinates(const Robot& robot) {
  std::vector<Coordinate> list;
  for (std::size_t k = 0; k < robot.joints.size(); ++k) {
    const RobotJoint& joint = robot.joints[k];
    if (joint.follows >= 0) continue;
    if (joint.compound < 0) {
      list.push_back({joint.joint, -1, {k}});
      continue;
    }
    const Id whole = robot.compounds[static_cast<std::size_t>(joint.compound)].joint;
    if (list.empty() || list.back().joint != whole) list.push_back({whole, joint.compound, {}});
    list.back().parts.push_back(k);
  }
  return list;
}

Coordinate find_coordinate(const graph::View& view, const Robot& robot, std::string_view name) {
  const auto named = [&](Id joint) {
    const std::string_view iri = view.terms().text(joint);
    return iri == name || algorithm::short_name(iri) == name;
  };
  const auto list = coordinates(robot);
  for (const Coordinate& coordinate : list)
    if (named(coordinate.joint)) return coordinate;
  for (const RobotJoint& joint : robot.joints) {
    if (joint.follows < 0 || !named(joint.joint)) continue;
    const Id leader = robot.joints[static_cast<std::size_t>(joint.follows)].joint;
    throw Error(Problem{
        {},
        std::string(view.terms().text(joint.joint)),
        fmt::format("it follows <{}> and has no numbers of its own", view.terms().text(leader)),
        "ask for the joint that it follows",
        {},
        {}});
  }
  std::string known;
  for (const Coordinate& coordinate : list)
    known += (known.empty() ? "" : ", ") +
             std::string(algorithm::short_name(view.terms().text(coordinate.joint)));
  throw Error(
      Problem{{}, std::string(name), "no moving joint has this name", "one of " + known, {}, {}});
}

void make_coordinate_inputs(Context& context, std::string_view slot) {
  const AsStep step(context);
  const auto& joints = context.robot.joints;
  for (const Coordinate& coordinate : coordinates(context.robot)) {
    if (!in_scope(context, coordinate)) continue;
    if (const RobotCompound* compound = compound_of(context, coordinate)) {
      const BlockIndex numbers = make_numbers(context, coordinate, slot, slot, Role::kInput);
      // Each of a free joint's turns and slides is at zero; what has moved is all before them.
      if (compound->is_free() && slot != "force") continue;
      take_parts(context, coordinate, slot, numbers);
    } else {
      BlockSpec spec = joint_quantity(slot, joints[coordinate.parts.front()]);
      spec.role = Role::kInput;
      context.make(spec);
    }
    if (slot == "force") continue;  // those that follow are driven by their leader
    for (const std::size_t part : coordinate.parts) lead(context, part, slot);
  }
}

BlockIndex gathered(Context& context, std::string_view slot, Id joint) {
  const AsStep step(context);
  const auto list = coordinates(context.robot);
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const Coordinate& one) { return one.joint == joint; });
  if (found == list.end()) return context.block(slot, joint);
  const BlockIndex first = context.block(slot, context.robot.joints[found->parts.front()].joint);
  const std::string_view quantity = context.builder.at(first).quantity->name;
  const bool force = quantity == "joint-force";
  if (!force && quantity != "joint-acceleration") {
    // What a joint of several degrees of freedom has only one of is behind the last of its parts.
    return context.block(slot, context.robot.joints[found->parts.back()].joint);
  }
  const RobotCompound* compound = compound_of(context, *found);
  if (compound == nullptr)
    return force ? coupled_force(context, slot, found->parts.front()) : first;
  if (!force && compound->is_free()) return whole_acceleration(context, *compound);
  std::vector<BlockIndex> blocks;
  for (const std::size_t part : found->parts)
    blocks.push_back(force ? coupled_force(context, slot, part)
                           : context.block(slot, context.robot.joints[part].joint));
  const BlockIndex made =
      make_numbers(context, *found, slot, force ? "force" : "acceleration", Role::kInternal);
  context.closure_of_many(force ? "join-joint-forces" : "join-joint-accelerations", blocks, {made},
                          joint);
  return made;
}

BlockIndex coupled_matrix(Context& context, BlockIndex matrix) {
  const algorithm::Block block = context.builder.at(matrix);
  const std::string_view operation = coupling_operator(block.quantity->name);
  const bool mass = block.quantity->name == "mass-matrix";
  if (operation.empty() || (!context.robot.coupled() && !(mass && has_rotors(context.robot))))
    return matrix;
  const AsStep step(context);
  const std::vector<double> map = coupling(context, mass);
  const std::string slot = "coupled-" + block.slot, map_slot = "coupling-of-" + block.slot;
  BlockSpec spec = {.slot = map_slot,
                    .represents = block.represents,
                    .quantity = "coordinate-map",
                    .of = context.robot.root_body,
                    .wrt = context.robot.root_body,
                    .seen_by = context.robot.root_frame,
                    .role = Role::kConstant,
                    .size = static_cast<std::uint32_t>(map.size()),
                    .value = map};
  const BlockIndex map_block = context.make(spec);
  const auto rows = static_cast<std::uint32_t>(map[0]),
             columns = static_cast<std::uint32_t>(map[1]);
  const BlockIndex coupled =
      context.make({.slot = slot,
                    .represents = block.represents,
                    .quantity = block.quantity->name,
                    .of = block.symbols[0],
                    .wrt = block.symbols[1],
                    .reference = block.symbols[2],
                    .seen_by = block.symbols[3],
                    .size = mass ? columns * columns : block.size / rows * columns,
                    .label = mass ? algorithm::kWholeRobot : std::string_view()});
  context.closure_with_counts(operation, {matrix, map_block, coupled}, {1, 1, 1}, block.represents);
  return coupled;
}

void hand_out(Context& context, std::string_view slot, Id element, std::string_view name) {
  if (slot == "force-share" && context.robot.coupled()) {
    const BlockIndex alone = context.board.find(slot, element);
    if (alone != algorithm::kNoIndex)
      context.builder.rename(alone, "alone-" + context.builder.at(alone).name);
    const BlockIndex share = coupled_share(context, element);
    if (share == alone) context.builder.rename(share, context.builder.at(share).name.substr(6));
    context.builder.output(share);
    return;
  }
  const BlockIndex own = context.board.find(slot, element);
  const bool input = own != algorithm::kNoIndex && context.builder.at(own).role == Role::kInput;
  const BlockIndex result =
      input ? own
            : coupled_matrix(context, own != algorithm::kNoIndex && !context.robot.coupled()
                                          ? own
                                          : gathered(context, slot, element));
  if (own == algorithm::kNoIndex && name.empty() &&
      context.builder.at(result).represents != element)
    context.builder.rename(
        result, std::string(slot) + "." +
                    std::string(algorithm::short_name(context.view.terms().text(element))));
  if (result != own && own != algorithm::kNoIndex) {
    // The joint's alone, and that of all that it moves, cannot have the same name.
    const std::string taken = name.empty() ? context.builder.at(own).name : std::string(name);
    context.builder.rename(own, "alone-" + taken);
    context.builder.rename(result, taken);
  }
  context.builder.output(result, name);
}

}  // namespace sinew::synthesis
