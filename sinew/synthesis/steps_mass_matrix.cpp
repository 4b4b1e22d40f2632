// The mass matrix by composite bodies (Walker and Orin 1982; Featherstone 2008, table 6.2): a
// column is the forces that one unit of acceleration of one joint takes, while the others are held.
// The wrench of each joint travels inward by itself and meets the joints that it passes; entries of
// joints on different branches are zero and cost nothing.
#include "sinew/synthesis/block_specs.h"
#include "sinew/synthesis/composite.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::kNoIndex;

constexpr std::string_view kCarried = "acceleration-wrench";

}  // namespace

BlockIndex composite_so_far(Context& context, Id frame, Id body) {
  const BlockIndex sum = context.board.find("composite-inertia", frame);
  if (sum != kNoIndex) return sum;
  if (context.has("inertia", body)) return context.block("inertia", body);
  return context.make(zero(at_frame("no-inertia", "rigid-body-inertia", body, body, frame)));
}

namespace {

void configure_composite(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto make = [&](std::string_view slot, Id of, Id frame) {
    return context.make(at_frame(slot, "rigid-body-inertia", edge.joint, of, frame));
  };
  composite_so_far(context, edge.child, edge.successor);
  make("composite-inertia-at-joint", edge.successor, edge.joint_frame);
  make("composite-inertia-at-predecessor", edge.successor, edge.parent);
  context.board.put("composite-inertia-before", edge.joint,
                    composite_so_far(context, edge.parent, edge.predecessor));
  context.board.put("composite-inertia", edge.parent,
                    make("composite-inertia-with", edge.predecessor, edge.parent));
}

void compute_composite(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto block = [&](std::string_view slot) { return context.block(slot, edge.joint); };
  const std::string_view transform = "transform-rigid-body-inertia-to-proximal";
  context.closure(
      transform,
      {block("pose-across-joint"), composite_so_far(context, edge.child, edge.successor),
       block("composite-inertia-at-joint")},
      edge.joint);
  context.closure(transform,
                  {block("placement"), block("composite-inertia-at-joint"),
                   block("composite-inertia-at-predecessor")},
                  edge.joint);
  context.closure("accumulate-rigid-body-inertia",
                  {block("composite-inertia-before"), block("composite-inertia-at-predecessor"),
                   block("composite-inertia-with")},
                  edge.joint);
}

std::string label(const Context& context, Id a, Id b) {
  const graph::Terms& terms = context.view.terms();
  return std::string(algorithm::short_name(terms.text(a))) + "." +
         std::string(algorithm::short_name(terms.text(b)));
}

// The wrench of joint `origin` where it meets joint `edge.joint`, and the entry that it makes
// there.
BlockIndex make_wrench(Context& context, std::string_view slot, const JointEdge& edge, Id origin,
                       Id of, Id frame) {
  const std::string name = label(context, edge.joint, origin);
  BlockSpec spec = at_frame(slot, "wrench", context.pair(edge.joint, origin), of, frame);
  spec.label = name;
  return context.make(spec);
}

void configure_entries(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  if (edge.floats()) return;  // the wrenches that reach it are its entries
  context.board.carry(kCarried, edge.child,
                      {edge.joint, make_wrench(context, "unit-acceleration-wrench", edge,
                                               edge.joint, edge.successor, edge.child)});
  const std::vector<Blackboard::Carried> effects = context.board.carried(kCarried, edge.child);
  for (const auto& [origin, wrench] : effects) {
    const Id of = context.builder.at(wrench).symbols[0];
    const std::string name = label(context, edge.joint, origin);
    context.make({.slot = "mass-matrix-entry",
                  .represents = context.pair(edge.joint, origin),
                  .quantity = "joint-force",
                  .of = of,
                  .wrt = edge.predecessor,
                  .seen_by = edge.child,
                  .prismatic = edge.kind == "prismatic",
                  .label = name});
    if (edge.parent == context.robot.root_frame) continue;
    make_wrench(context, "acceleration-wrench-at-joint", edge, origin, of, edge.joint_frame);
    context.board.carry(kCarried, edge.parent,
                        {origin, make_wrench(context, "acceleration-wrench-at-predecessor", edge,
                                             origin, of, edge.parent)});
  }
}

void compute_entries(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  if (edge.floats()) return;
  context.closure("wrench-of-" + edge.kind + "-from-rigid-body-inertia",
                  {composite_so_far(context, edge.child, edge.successor),
                   context.block("unit-acceleration-wrench", context.pair(edge.joint, edge.joint))},
                  edge.joint);
  for (const auto& [origin, wrench] : context.board.carried(kCarried, edge.child)) {
    const Id pair = context.pair(edge.joint, origin);
    context.closure("force-from-wrench-" + edge.kind,
                    {wrench, context.block("mass-matrix-entry", pair)}, edge.joint);
    if (edge.parent == context.robot.root_frame) continue;
    const BlockIndex at_joint = context.block("acceleration-wrench-at-joint", pair);
    context.closure("transform-wrench-to-proximal",
                    {context.block("pose-across-joint", edge.joint), wrench, at_joint}, edge.joint);
    context.closure("transform-wrench-to-proximal",
                    {context.block("placement", edge.joint), at_joint,
                     context.block("acceleration-wrench-at-predecessor", pair)},
                    edge.joint);
  }
}

void configure_matrix(Context& context, const Visit& visit) {
  auto n = static_cast<std::uint32_t>(context.robot.joints.size());
  if (context.query.floating) n += 5;
  context.make({.slot = "mass-matrix",
                .represents = visit["body"],
                .quantity = "mass-matrix",
                .size = n * n,
                .label = algorithm::kWholeRobot});
  context.make(zero({.slot = "no-force",
                     .represents = visit["body"],
                     .quantity = "joint-force",
                     .of = visit["body"],
                     .wrt = visit["body"],
                     .seen_by = visit.node}));
}

// Symmetric: the entry of two joints was made where the outer one's wrench met the inner one.
std::vector<BlockIndex> entries(Context& context, Id root_body) {
  std::vector<BlockIndex> found;
  for (const RobotJoint& row : context.robot.joints)
    for (const RobotJoint& column : context.robot.joints) {
      if (row.kind == "floating" || column.kind == "floating") continue;
      BlockIndex entry =
          context.board.find("mass-matrix-entry", context.pair(row.joint, column.joint));
      if (entry == kNoIndex)
        entry = context.board.find("mass-matrix-entry", context.pair(column.joint, row.joint));
      found.push_back(entry != kNoIndex ? entry : context.block("no-force", root_body));
    }
  return found;
}

// The composite inertia of a floating base, and the wrench of each joint where it reaches it.
void compute_floating_matrix(Context& context, const Visit& visit) {
  const RobotJoint& base = context.robot.joints.front();
  const std::vector<BlockIndex> all = entries(context, visit["body"]);
  std::vector<BlockIndex> parts = {composite_so_far(context, base.frame, base.successor)};
  for (const RobotJoint& joint : context.robot.joints)
    for (const auto& [origin, wrench] : context.board.carried(kCarried, base.frame))
      if (origin == joint.joint) parts.push_back(wrench);
  const auto joints = static_cast<std::uint32_t>(parts.size() - 1);
  parts.insert(parts.end(), all.begin(), all.end());
  parts.push_back(context.block("mass-matrix", visit["body"]));
  context.closure_with_counts("floating-mass-matrix-from-parts", std::move(parts),
                              {1, joints, joints * joints, 1}, visit["body"]);
}

void compute_matrix(Context& context, const Visit& visit) {
  if (context.query.floating)
    compute_floating_matrix(context, visit);
  else
    context.closure_of_many("mass-matrix-from-entries", entries(context, visit["body"]),
                            {context.block("mass-matrix", visit["body"])}, visit["body"]);
}

}  // namespace

Step composite_inertia_step() {
  return {.name = "composite-inertia",
          .purpose = "what hangs on a body moves with it while the joints behind are held",
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"inertia", "placement", "pose-across-joint"},
          .may_use = {},
          .gives = {"composite-inertia"},
          .visitors = {{Where::kEdge,
                        {std::string(kParentIsNotRoot)},
                        {},
                        configure_composite,
                        compute_composite}}};
}

Step total_inertia_step() {
  return {.name = "total-inertia",
          .purpose = "all that moves, and the root, as one body seen from the root",
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"composite-inertia", "placement", "pose-across-joint"},
          .may_use = {},
          .gives = {"total-inertia"},
          .visitors = {{Where::kEdge,
                        {std::string(kParentIsRoot)},
                        {},
                        configure_composite,
                        compute_composite}}};
}

Step mass_matrix_step() {
  return {.name = "mass-matrix",
          .purpose = "the wrench of one unit of acceleration of each joint meets the joints before",
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"composite-inertia", "placement", "pose-across-joint"},
          .may_use = {},
          .gives = {"mass-matrix"},
          .visitors = {{Where::kEdge, {}, {}, configure_entries, compute_entries},
                       {Where::kNode,
                        {std::string(kIsRoot)},
                        std::string(kBodyOfNode),
                        configure_matrix,
                        compute_matrix}}};
}

}  // namespace sinew::synthesis
