// Wrenches from outside: brought to the frame of the body on which they act, where they either help
// to move the body at once, or travel inward by themselves to show their share of each joint's
// force.
#include "sinew/synthesis/block_specs.h"
#include "sinew/synthesis/external_wrenches.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::kNoIndex;
using algorithm::Role;

constexpr std::string_view kCarried = "external-wrench-effect";

BlockSpec wrench(std::string_view slot, Id represents, Id of, Id frame) {
  return at_frame(slot, "wrench", represents, of, frame);
}

std::vector<const ExternalWrench*> wrenches_on(const Context& context, Id body_frame) {
  std::vector<const ExternalWrench*> found;
  for (const ExternalWrench& one : context.wrenches)
    if (one.body_frame == body_frame) found.push_back(&one);
  return found;
}

void configure_at_body(Context& context, const Visit& visit) {
  const graph::Terms& terms = context.view.terms();
  const Id placement_of = terms.find_iri(std::string(algorithm::kTreeNamespace) + "placement");
  BlockIndex sum = kNoIndex;
  for (const ExternalWrench* one : wrenches_on(context, visit.node)) {
    BlockIndex at_body = context.block("wrench", one->frame);
    if (one->seen_from_base) {
      at_body = context.make(wrench("wrench-seen-from-frame", one->frame, one->body, one->frame));
      context.make({.slot = "pose",
                    .represents = one->frame,
                    .quantity = "pose",
                    .of = one->frame,
                    .wrt = context.robot.root_frame});
    }
    if (one->frame != one->body_frame) {
      context.make({.slot = "frame-placement",
                    .represents = one->frame,
                    .quantity = "pose",
                    .of = one->frame,
                    .wrt = one->body_frame,
                    .role = Role::kConstant,
                    .value = context.numbers(context.view.object(one->frame, placement_of))});
      at_body = context.make(wrench("wrench-at-body", one->frame, one->body, one->body_frame));
    }
    context.board.put("external-wrench-alone", one->frame, at_body);
    if (sum != kNoIndex)
      at_body = context.make(wrench("external-wrench-with", one->frame, one->body, visit.node));
    sum = at_body;
  }
  if (sum != kNoIndex) context.board.put("external-wrench", visit.node, sum);
}

void compute_at_body(Context& context, const Visit& visit) {
  BlockIndex sum = kNoIndex;
  for (const ExternalWrench* one : wrenches_on(context, visit.node)) {
    BlockIndex given = context.block("wrench", one->frame);
    if (one->seen_from_base) {
      const BlockIndex turned = context.block("wrench-seen-from-frame", one->frame);
      if (one->frame != one->body_frame)
        context.closure(
            "compose-pose",
            {context.block("pose", one->body_frame), context.block("frame-placement", one->frame),
             context.block("pose", one->frame)},
            one->frame);
      context.closure("rotate-wrench-to-distal", {context.block("pose", one->frame), given, turned},
                      one->frame);
      given = turned;
    }
    const BlockIndex at_body = context.block("external-wrench-alone", one->frame);
    if (at_body != given)
      context.closure("transform-wrench-to-proximal",
                      {context.block("frame-placement", one->frame), given, at_body}, one->frame);
    if (sum == kNoIndex) {
      sum = at_body;
      continue;
    }
    const BlockIndex with = context.block("external-wrench-with", one->frame);
    context.closure("accumulate-wrench", {sum, at_body, with}, visit["body"]);
    sum = with;
  }
}

Step at_body_step(std::string name, std::vector<std::string> needs) {
  return {.name = name,
          .purpose = "what acts on a link from outside helps to move it",
          .direction = Direction::kLocal,
          .expansion = std::string(kAcrossJoints),
          .needs = std::move(needs),
          .may_use = {},
          .gives = {name},
          .visitors = {{Where::kNode,
                        {std::string(kIsNotRoot)},
                        std::string(kBodyOfNode),
                        configure_at_body,
                        compute_at_body}}};
}

std::string label(const Context& context, const JointEdge& edge, Id frame) {
  std::string text(edge.label.empty() ? algorithm::short_name(context.view.terms().text(edge.joint))
                                      : edge.label);
  for (const ExternalWrench& one : context.wrenches)
    if (one.frame == frame) text += "." + one.label;
  return text;
}

void configure_share(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  for (const ExternalWrench* one : wrenches_on(context, edge.child))
    context.board.carry(kCarried, edge.child,
                        {one->frame, context.block("external-wrench-alone", one->frame)});
  const auto effects = context.board.carried(kCarried, edge.child);  // a copy: more are carried on
  for (const auto& [origin, effect] : effects) {
    const Id pair = context.pair(edge.joint, origin);
    const std::string name = label(context, edge, origin);
    for (const std::string_view slot : {"force-of-wrench", "force-share", "no-force-of-wrench"}) {
      BlockSpec spec = edge.coordinate(slot, "force");
      spec.represents = pair;
      spec.label = name;
      context.make(slot == "no-force-of-wrench" ? zero(spec) : spec);
    }
    const auto alone = [&](std::string_view slot, Id frame) {
      BlockSpec spec = wrench(slot, pair, edge.successor, frame);
      spec.label = name;
      return spec;
    };
    // It now acts on all that is behind this joint.
    context.make(alone("wrench-alone", edge.child));
    context.make(zero(alone("no-wrench", edge.child)));
    if (edge.parent == context.robot.root_frame) continue;
    context.make(alone("wrench-at-joint-alone", edge.joint_frame));
    context.board.carry(kCarried, edge.parent,
                        {origin, context.make(alone("wrench-at-predecessor-alone", edge.parent))});
  }
}

// The joint's share is minus what the wrench does along the joint.
void compute_share(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto& effects = context.board.carried(kCarried, edge.child);
  for (const auto& [origin, effect] : effects) {
    const Id pair = context.pair(edge.joint, origin);
    const auto block = [&](std::string_view slot) { return context.block(slot, pair); };
    const BlockIndex alone = block("wrench-alone");
    context.closure("accumulate-wrench", {block("no-wrench"), effect, alone}, edge.joint);
    context.closure("force-from-wrench-" + edge.kind, {alone, block("force-of-wrench")},
                    edge.joint);
    context.closure(edge.floats() ? "subtract-floating-force" : "subtract-joint-force",
                    {block("no-force-of-wrench"), block("force-of-wrench"), block("force-share")},
                    edge.joint);
    if (edge.parent == context.robot.root_frame) continue;
    const BlockIndex at = block("wrench-at-joint-alone");
    context.closure("transform-wrench-to-proximal",
                    {context.block("pose-across-joint", edge.joint), alone, at}, edge.joint);
    context.closure(
        "transform-wrench-to-proximal",
        {context.block("placement", edge.joint), at, block("wrench-at-predecessor-alone")},
        edge.joint);
  }
}

}  // namespace

Step external_wrench_step() { return at_body_step("external-wrench", {"wrench"}); }

Step external_wrench_from_base_step() {
  return at_body_step("external-wrench-from-base", {"wrench", "pose"});
}

Step force_share_step() {
  return {.name = "force-share",
          .purpose = "each wrench from outside travels inward by itself and meets the joints",
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"wrench", "placement", "pose-across-joint"},
          .may_use = {"external-wrench", "external-wrench-from-base"},
          .gives = {"force-share"},
          .visitors = {{Where::kEdge, {}, {}, configure_share, compute_share}}};
}

}  // namespace sinew::synthesis
