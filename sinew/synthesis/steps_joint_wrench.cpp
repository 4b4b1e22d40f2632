// The whole wrench that a joint transmits from its predecessor to its successor: what a bearing
// carries, and what drives the joint. About the origin of the successor link's own frame, and seen
// from it.
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/needed_wrench.h"
#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::Role;

constexpr double kIdentity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

Id link_frame(const Context& context, const JointEdge& edge) {
  const Id property =
      context.view.terms().find_iri(std::string(algorithm::kTreeNamespace) + "root-frame");
  const Id frame = property ? context.view.object(edge.successor, property) : Id{};
  return frame ? frame : edge.child;
}

void configure(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const Id frame = link_frame(context, edge);
  const auto wrench = [&](std::string_view slot, Id at) {
    context.make({.slot = slot,
                  .represents = edge.joint,
                  .quantity = "wrench",
                  .of = edge.successor,
                  .reference = at,
                  .seen_by = at,
                  .label = edge.label});
  };
  for (const ExternalWrench& one : context.wrenches)
    if (context.query.forces == Forces::kApart)
      throw Error(Problem{{},
                          std::string(context.view.terms().text(one.frame)),
                          "joint-wrench cannot be asked for while forces are kept apart",
                          "let forces be added up together, or ask for joint-force-share",
                          {},
                          {}});
  wrench("joint-wrench", frame);
  const Id placement =
      context.view.terms().find_iri(std::string(algorithm::kTreeNamespace) + "placement");
  context.make({.slot = "frame-placement",
                .represents = frame,
                .quantity = "pose",
                .of = frame,
                .wrt = edge.child,
                .role = Role::kConstant,
                .value = frame == edge.child
                             ? std::vector<double>(std::begin(kIdentity), std::end(kIdentity))
                             : context.numbers(context.view.object(frame, placement))});
  context.make({.slot = "body-seen-from-frame",
                .represents = frame,
                .quantity = "pose",
                .of = edge.child,
                .wrt = frame});
}

void compute(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const Id frame = link_frame(context, edge);
  const BlockIndex needed = needed_wrench_so_far(Motion::kFull, context, edge.child);
  const BlockIndex body = context.block("body-seen-from-frame", frame);
  context.closure("invert-pose", {context.block("frame-placement", frame), body}, edge.joint);
  context.closure("transform-wrench-to-proximal",
                  {body, needed, context.block("joint-wrench", edge.joint)}, edge.joint);
}

}  // namespace

Step joint_wrench_step() {
  return {.name = "joint-wrench",
          .purpose = "all that a joint transmits, seen from the link behind it",
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"body-wrench"},
          .may_use = {},
          .gives = {"joint-wrench"},
          .visitors = {{Where::kEdge, {}, {}, configure, compute}}};
}

}  // namespace sinew::synthesis
