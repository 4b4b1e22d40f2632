#include "sinew/synthesis/rotor.h"

#include <algorithm>

namespace sinew::synthesis {
namespace {

double rotor_inertia(const Context& context, Id joint) {
  const auto& joints = context.robot.joints;
  const auto found = std::find_if(joints.begin(), joints.end(),
                                  [&](const RobotJoint& one) { return one.joint == joint; });
  return found == joints.end() ? 0 : found->rotor_inertia;
}

std::string without_rotor(const Context& context, BlockIndex force) {
  return context.builder.at(force).slot + "-without-rotor";
}

}  // namespace

bool has_rotor(const Context& context, Id joint) { return rotor_inertia(context, joint) != 0; }

void make_rotor(Context& context, const JointEdge& edge, std::string_view slot) {
  if (!has_rotor(context, edge.joint)) return;
  const double inertia[] = {rotor_inertia(context, edge.joint)};
  context.make({.slot = "rotor-inertia",
                .represents = edge.joint,
                .quantity = "rotor-inertia",
                .role = algorithm::Role::kConstant,
                .prismatic = edge.kind == "prismatic",
                .value = inertia,
                .label = edge.label});
  const std::string without = std::string(slot) + "-without-rotor";
  context.make(edge.coordinate(without, "force"));
}

void compute_with_rotor(Context& context, const JointEdge& edge, std::string_view operation,
                        BlockIndex wrench, std::initializer_list<BlockIndex> others,
                        BlockIndex force) {
  const std::string project = "force-from-wrench-" + edge.kind;
  if (!has_rotor(context, edge.joint)) {
    context.closure(project, {wrench, force}, edge.joint);
    return;
  }
  const BlockIndex alone = context.block(without_rotor(context, force), edge.joint);
  context.closure(project, {wrench, alone}, edge.joint);
  std::vector<BlockIndex> arguments = {alone};
  arguments.insert(arguments.end(), others);
  arguments.push_back(context.block("rotor-inertia", edge.joint));
  arguments.push_back(force);
  context.closure_with_counts(operation, std::move(arguments), {}, edge.joint);
}

}  // namespace sinew::synthesis
