// Forward dynamics: the articulated-body algorithm (Featherstone 1983) for a robot at rest. What
// velocities and gravity need is in the bias wrenches, which come from inverse dynamics; so the
// expensive recursion over inertias carries no velocity terms, and the transforms need no Coriolis
// parts.
#include <functional>

#include "sinew/base/error.h"
#include "sinew/synthesis/block_specs.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/rotor.h"
#include "sinew/synthesis/step_list.h"
#include "sinew/synthesis/weightless.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::kNoIndex;

void configure_own(Context& context, const Visit& visit) {
  const BlockSpec spec = at_frame("own-articulated-inertia", "articulated-body-inertia", visit.node,
                                  visit["body"], visit.node);
  context.make(context.has("inertia", visit["body"]) ? spec : zero(spec));
}

void compute_own(Context& context, const Visit& visit) {
  if (!context.has("inertia", visit["body"])) return;
  context.closure("articulated-from-rigid-body-inertia",
                  {context.block("inertia", visit["body"]),
                   context.block("own-articulated-inertia", visit.node)},
                  visit["body"]);
}

BlockIndex sum_so_far(const Context& context, std::string_view slot, std::string_view own,
                      Id frame) {
  const BlockIndex sum = context.board.find(slot, frame);
  return sum != kNoIndex ? sum : context.block(own, frame);
}

BlockIndex inertia_so_far(const Context& context, Id frame) {
  return sum_so_far(context, "articulated-inertia", "own-articulated-inertia", frame);
}

void configure_inertia(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  if (edge.floats()) return;  // six columns at once: see compute_result
  context.make(at_frame("unit-wrench", "wrench", edge.joint, edge.successor, edge.child));
  context.make(edge.coordinate("unit-force", "force"));
  make_rotor(context, edge, "unit-force");
}

void compute_inertia(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  if (edge.floats()) return;
  const BlockIndex unit = context.block("unit-wrench", edge.joint);
  const BlockIndex force = context.block("unit-force", edge.joint);
  context.closure("wrench-of-" + edge.kind + "-from-articulated-body-inertia",
                  {inertia_so_far(context, edge.child), unit}, edge.joint);
  compute_with_rotor(context, edge, "unit-force-with-rotor", unit, {}, force);
}

void configure_handing_on(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto make = [&](std::string_view slot, Id of, Id frame) {
    return context.make(at_frame(slot, "articulated-body-inertia", edge.joint, of, frame));
  };
  make("projected-inertia", edge.successor, edge.child);
  make("articulated-inertia-at-joint", edge.successor, edge.joint_frame);
  make("articulated-inertia-at-predecessor", edge.successor, edge.parent);
  context.board.put("articulated-inertia-before", edge.joint, inertia_so_far(context, edge.parent));
  context.board.put("articulated-inertia", edge.parent,
                    make("articulated-inertia-with", edge.predecessor, edge.parent));
}

void compute_handing_on(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto block = [&](std::string_view slot) { return context.block(slot, edge.joint); };
  const std::string_view transform = "transform-articulated-body-inertia-to-proximal";
  context.closure("project-articulated-body-inertia",
                  {inertia_so_far(context, edge.child), block("unit-wrench"), block("unit-force"),
                   block("projected-inertia")},
                  edge.joint);
  context.closure(transform,
                  {block("pose-across-joint"), block("projected-inertia"),
                   block("articulated-inertia-at-joint")},
                  edge.joint);
  context.closure(transform,
                  {block("placement"), block("articulated-inertia-at-joint"),
                   block("articulated-inertia-at-predecessor")},
                  edge.joint);
  context.closure("accumulate-articulated-body-inertia",
                  {block("articulated-inertia-before"), block("articulated-inertia-at-predecessor"),
                   block("articulated-inertia-with")},
                  edge.joint);
}

// Whether the wrenches that bodies need at the bias travel with those that drive them, in one sum:
// each travels the same way, and what joints must balance is the sum's share. Where bias forces are
// there for another reason, the drive travels alone.
enum class Drive : std::uint8_t { kWithBias, kAlone };

// The wrench that a body needs so far because of the forces of the joints behind it, and at the
// bias.
BlockIndex drive_so_far(Drive drive, Context& context, Id frame, Id body) {
  const BlockIndex sum = context.board.find("drive-wrench", frame);
  if (sum != kNoIndex) return sum;
  if (drive == Drive::kWithBias) return context.block("bias-own-wrench", frame);
  return context.make(zero(at_frame("no-drive-wrench", "wrench", frame, body, frame)));
}

// What a body on which nothing hangs needs at the bias, where that has been computed at its joint.
BlockIndex bias_at_joint(Drive drive, const Context& context, const JointEdge& edge) {
  return drive == Drive::kWithBias ? context.board.find("bias-own-wrench-at-joint", edge.joint)
                                   : kNoIndex;
}

void configure_drive(Drive drive, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  drive_so_far(drive, context, edge.child, edge.successor);
  if (drive == Drive::kAlone) context.make(edge.coordinate("free-force", "force"));
  for (const std::string_view slot : {"force-behind", "drive-force"})
    context.make(edge.coordinate(slot, "force"));
}

// u = tau - S' W, or (tau - h) - S' W
void compute_drive(Drive drive, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const std::string subtract = edge.floats() ? "subtract-floating-force" : "subtract-joint-force";
  const auto block = [&](std::string_view slot) { return context.block(slot, edge.joint); };
  if (drive == Drive::kAlone)
    context.closure(subtract, {block("force"), block("bias-force"), block("free-force")},
                    edge.joint);
  context.closure("force-from-wrench-" + edge.kind,
                  {drive_so_far(drive, context, edge.child, edge.successor), block("force-behind")},
                  edge.joint);
  context.closure(subtract,
                  {block(drive == Drive::kAlone ? "free-force" : "force"), block("force-behind"),
                   block("drive-force")},
                  edge.joint);
}

void configure_drive_on(Drive drive, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto make = [&](std::string_view slot, Id of, Id frame) {
    return context.make(at_frame(slot, "wrench", edge.joint, of, frame));
  };
  if (bias_at_joint(drive, context, edge) != kNoIndex)
    make("unit-wrench-at-joint", edge.successor, edge.joint_frame);
  else
    make("projected-wrench", edge.successor, edge.child);
  make("drive-wrench-at-joint", edge.successor, edge.joint_frame);
  make("drive-wrench-at-predecessor", edge.successor, edge.parent);
  context.board.put("drive-wrench-before", edge.joint,
                    drive_so_far(drive, context, edge.parent, edge.predecessor));
  context.board.put("drive-wrench", edge.parent,
                    make("drive-wrench-with", edge.predecessor, edge.parent));
}

void compute_drive_on(Drive drive, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto block = [&](std::string_view slot) { return context.block(slot, edge.joint); };
  const std::string_view transform = "transform-wrench-to-proximal";
  const BlockIndex bias = bias_at_joint(drive, context, edge);
  if (bias != kNoIndex) {
    // The unit wrench varies less than what it is multiplied with.
    context.closure(
        transform,
        {block("pose-across-joint"), block("unit-wrench"), block("unit-wrench-at-joint")},
        edge.joint);
    context.closure("project-wrench",
                    {bias, block("unit-wrench-at-joint"), block("unit-force"), block("drive-force"),
                     block("drive-wrench-at-joint")},
                    edge.joint);
  } else {
    context.closure("project-wrench",
                    {drive_so_far(drive, context, edge.child, edge.successor), block("unit-wrench"),
                     block("unit-force"), block("drive-force"), block("projected-wrench")},
                    edge.joint);
    context.closure(
        transform,
        {block("pose-across-joint"), block("projected-wrench"), block("drive-wrench-at-joint")},
        edge.joint);
  }
  context.closure(
      transform,
      {block("placement"), block("drive-wrench-at-joint"), block("drive-wrench-at-predecessor")},
      edge.joint);
  context.closure("accumulate-wrench",
                  {block("drive-wrench-before"), block("drive-wrench-at-predecessor"),
                   block("drive-wrench-with")},
                  edge.joint);
}

void configure_root(Context& context, const Visit& visit) {
  context.make(zero(at_frame("drive-acceleration", "acceleration-twist", visit.node, visit["body"],
                             visit.node, context.reference)));
}

void configure_result(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto make = [&](std::string_view slot, Id represents, Id of, Id wrt, Id frame) {
    context.make(at_frame(slot, "acceleration-twist", represents, of, frame, wrt));
  };
  make("drive-acceleration-at-joint", edge.joint, edge.predecessor, context.reference,
       edge.joint_frame);
  make("drive-acceleration-across-joint", edge.joint, edge.predecessor, context.reference,
       edge.child);
  make("drive-relative-acceleration", edge.joint, edge.successor, edge.predecessor, edge.child);
  make("drive-acceleration", edge.child, edge.successor, context.reference, edge.child);
  context.make(edge.coordinate("acceleration", "acceleration"));
  if (edge.floats())
    context.make(zero(at_frame("no-relative-twist", "velocity-twist", edge.joint, edge.successor,
                               edge.child, edge.predecessor)));
}

void compute_result(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto block = [&](std::string_view slot) { return context.block(slot, edge.joint); };
  const std::string_view transform = "transform-acceleration-twist-to-distal-at-rest";
  context.closure(transform,
                  {block("placement"), context.block("drive-acceleration", edge.parent),
                   block("drive-acceleration-at-joint")},
                  edge.joint);
  context.closure(transform,
                  {block("pose-across-joint"), block("drive-acceleration-at-joint"),
                   block("drive-acceleration-across-joint")},
                  edge.joint);
  if (edge.floats()) {
    // The world rests, so only the base's own inertia and drive matter.
    context.closure(
        "floating-acceleration-from-force",
        {inertia_so_far(context, edge.child), block("drive-force"), block("acceleration")},
        edge.joint);
    context.closure(
        "acceleration-to-twist-floating",
        {block("acceleration"), block("no-relative-twist"), block("drive-relative-acceleration")},
        edge.joint);
  } else {
    const bool at_joint = context.has("unit-wrench-at-joint", edge.joint);
    context.closure(
        "joint-acceleration-from-force",
        {block("drive-force"), block(at_joint ? "unit-wrench-at-joint" : "unit-wrench"),
         block("unit-force"),
         block(at_joint ? "drive-acceleration-at-joint" : "drive-acceleration-across-joint"),
         block("acceleration")},
        edge.joint);
    context.closure("acceleration-to-twist-" + edge.kind,
                    {block("acceleration"), block("drive-relative-acceleration")}, edge.joint);
  }
  context.closure("add-acceleration-twist",
                  {block("drive-acceleration-across-joint"), block("drive-relative-acceleration"),
                   context.block("drive-acceleration", edge.child)},
                  edge.child);
}

}  // namespace

Step own_articulated_inertia_step() {
  const std::string body(kBodyOfNode), moves(kIsNotRoot);
  return {
      .name = "own-articulated-inertia",
      .purpose = "each body by itself resists acceleration with its own inertia",
      .direction = Direction::kLocal,
      .expansion = std::string(kAcrossJoints),
      .needs = {"inertia"},
      .may_use = {},
      .gives = {"own-articulated-inertia"},
      .visitors = {{Where::kNode, {moves}, body, configure_own, compute_own}, refuse_weightless()}};
}

Step articulated_inertia_step() {
  return {.name = "articulated-inertia",
          .purpose = "each body hands on to its predecessor how it resists through a free joint",
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"placement", "pose-across-joint", "own-articulated-inertia"},
          .may_use = {},
          .gives = {"unit-wrench", "unit-force"},
          .visitors = {{Where::kEdge, {}, {}, configure_inertia, compute_inertia},
                       {Where::kEdge,
                        {std::string(kParentIsNotRoot)},
                        {},
                        configure_handing_on,
                        compute_handing_on}},
          .takes_joints_one_by_one = true};
}

namespace {

Step drive_step_of(Drive drive, std::string name, std::string purpose, std::string bias) {
  return {.name = std::move(name),
          .purpose = std::move(purpose),
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"force", std::move(bias), "unit-wrench", "unit-force", "placement",
                    "pose-across-joint"},
          .may_use = {},
          .gives = {"drive-force"},
          .visitors = {{Where::kEdge,
                        {},
                        {},
                        std::bind_front(configure_drive, drive),
                        std::bind_front(compute_drive, drive)},
                       {Where::kEdge,
                        {std::string(kParentIsNotRoot)},
                        {},
                        std::bind_front(configure_drive_on, drive),
                        std::bind_front(compute_drive_on, drive)}}};
}

}  // namespace

Step drive_step() {
  return drive_step_of(
      Drive::kAlone, "joint-drive",
      "what joint forces leave beyond the bias drives the joints and the bodies before",
      "bias-force");
}

Step drive_with_bias_step() {
  return drive_step_of(
      Drive::kWithBias, "joint-drive-with-bias",
      "what joint forces leave beyond what bodies need drives the joints and the bodies before",
      "bias-own-wrench");
}

Step forward_dynamics_step() {
  return {.name = "forward-dynamics",
          .purpose = "accelerations follow from the root outward",
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"drive-force", "unit-wrench", "unit-force", "placement", "pose-across-joint"},
          .may_use = {},
          .gives = {"acceleration"},
          .visitors = {
              {Where::kNode, {std::string(kIsRoot)}, std::string(kBodyOfNode), configure_root, {}},
              {Where::kEdge, {}, {}, configure_result, compute_result}}};
}

}  // namespace sinew::synthesis
