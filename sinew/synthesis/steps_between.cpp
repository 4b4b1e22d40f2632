// Poses, motions and Jacobians of any frame with respect to any other, seen by any: outputs that
// look at two places of the tree at once, and so come after the outward sweep.
#include <algorithm>

#include "sinew/synthesis/between.h"
#include "sinew/synthesis/block_specs.h"
#include "sinew/synthesis/relation.h"
#include "sinew/synthesis/step_list.h"
#include "sinew/synthesis/whole_robot.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;

Id body(const Context& context, Id frame) { return body_of(context.robot, context.view, frame); }

// What is handed out for a relation, or a block on the way to it.
BlockSpec output(const Relation& relation, std::string_view slot, std::string_view quantity) {
  return {.slot = slot, .represents = relation.node, .quantity = quantity, .label = relation.label};
}

BlockSpec motion_output(const Context& context, const Relation& relation, std::string_view slot,
                        std::string_view quantity) {
  BlockSpec spec = output(relation, slot, quantity);
  spec.of = body(context, relation.of);
  spec.wrt = body(context, relation.with_respect_to);
  spec.reference = relation.of;
  spec.seen_by = relation.seen_by;
  return spec;
}

BlockSpec pose_output(const Relation& relation, std::string_view slot, std::string_view quantity) {
  BlockSpec spec = output(relation, slot, quantity);
  spec.of = relation.of;
  spec.wrt = relation.with_respect_to;
  return spec;
}

void make_pose(Context& context, const Relation& relation) {
  Between between(context);
  const BlockIndex made = context.make(pose_output(relation, "pose", "pose"));
  // The same pose under the name that was asked for.
  context.closure("compose-pose",
                  {between.pose(relation.with_respect_to, relation.of),
                   between.pose(relation.of, relation.of), made},
                  relation.of);
}

void make_coordinates(Context& context, const Relation& relation) {
  Between between(context);
  context.closure(
      "position-and-quaternion-from-pose",
      {between.pose(relation.with_respect_to, relation.of),
       context.make(pose_output(relation, "position-and-quaternion", "position-and-quaternion"))},
      relation.of);
}

void make_twist(Context& context, const Relation& relation) {
  Between between(context);
  between.turn(between.twist(relation.with_respect_to, relation.of), relation.of, relation.seen_by,
               context.make(motion_output(context, relation, "twist", "velocity-twist")));
}

void make_acceleration(Context& context, const Relation& relation) {
  Between between(context);
  BlockIndex made = between.acceleration(relation.with_respect_to, relation.of, Motion::kFull);
  const bool spatial = context.query.frames == Frames::kStationary;
  const std::string_view quantity = spatial ? "spatial-acceleration-twist" : "acceleration-twist";
  if (spatial) {
    BlockSpec spec = motion_output(context, relation, "spatial-acceleration", quantity);
    spec.seen_by = relation.of;
    const BlockIndex classical = made;
    made = context.make(spec);
    context.closure("spatial-acceleration-from-classical",
                    {classical, between.twist(relation.with_respect_to, relation.of), made},
                    relation.of);
  }
  between.turn(made, relation.of, relation.seen_by,
               context.make(motion_output(context, relation, "acceleration-twist", quantity)));
}

// The derivative of the Jacobian's numbers, times the velocities: the acceleration that is left
// without joint accelerations, and, where the directions turn, what that adds to the derivative.
void make_rate(Context& context, const Relation& relation) {
  Between between(context);
  const auto& [node, of, wrt, seen_by, label, quantity] = relation;
  const std::string_view slot = "jacobian-rate-times-velocity";
  const BlockIndex acceleration = between.acceleration(wrt, of, Motion::kBias);
  const BlockIndex made =
      context.make(motion_output(context, relation, slot, "acceleration-twist"));
  if (body(context, wrt) == body(context, seen_by)) {
    between.turn(acceleration, of, seen_by, made);
    return;
  }
  const BlockIndex turned = context.make(
      motion_output(context, relation, "bias-acceleration-seen", "acceleration-twist"));
  between.turn(acceleration, of, seen_by, turned);
  const BlockIndex twist =
      context.make(motion_output(context, relation, "twist-seen", "velocity-twist"));
  between.turn(between.twist(wrt, of), of, seen_by, twist);
  context.closure("derivative-seen-by-observer", {turned, twist, between.twist(wrt, seen_by), made},
                  of);
}

// ---- Jacobians ----

// The joints whose velocities are given, in their order.
std::vector<const RobotJoint*> joints_of(const Context& context) {
  std::vector<const RobotJoint*> joints;
  for (const RobotJoint& joint : context.robot.joints)
    if (context.scope.empty() || context.scope.contains(joint.frame)) joints.push_back(&joint);
  return joints;
}

class Columns {
 public:
  Columns(Context& context, const Relation& relation)
      : context_(context),
        relation_(relation),
        way_(way_between(context.robot, context.view, relation.of, relation.with_respect_to)) {}

  // The column of each joint, in the order of the joints.
  std::vector<BlockIndex> make() {
    std::vector<BlockIndex> columns;
    for (const RobotJoint* joint : joints_of(context_)) columns.push_back(column(*joint));
    return columns;
  }

 private:
  bool on(const std::vector<std::size_t>& way, const RobotJoint& joint) const {
    return std::any_of(way.begin(), way.end(),
                       [&](std::size_t index) { return &context_.robot.joints[index] == &joint; });
  }

  BlockIndex block(std::string_view slot, const RobotJoint& joint, Id wrt, Id seen_by,
                   bool unmoved = false) {
    const std::string label =
        relation_.label + "." +
        std::string(joint.label.empty()
                        ? algorithm::short_name(context_.view.terms().text(joint.joint))
                        : joint.label);
    const BlockSpec spec = {.slot = slot,
                            .represents = context_.pair(relation_.node, joint.joint),
                            .quantity = floats(joint) ? "jacobian-block" : "jacobian-column",
                            .of = relation_.of,
                            .wrt = wrt,
                            .reference = relation_.of,
                            .seen_by = seen_by,
                            .prismatic = joint.kind == "prismatic",
                            .label = label};
    return context_.make(unmoved ? zero(spec) : spec);
  }

  static bool floats(const RobotJoint& joint) { return joint.kind == "floating"; }

  BlockIndex column(const RobotJoint& joint) {
    const Id base = way_.base_frame;
    const bool moved = on(way_.to_one, joint), moving = on(way_.to_other, joint);
    const BlockIndex with_one = block("column-of-one", joint, base, base, !moved);
    const BlockIndex with_other = block("column-of-other", joint, base, base, !moving);
    const std::string s = floats(joint) ? "s" : "";
    if (moved || moving)
      context_.closure("jacobian-column" + s + "-" + joint.kind,
                       {between_.pose_from(base, joint.frame),
                        between_.pose_from(base, relation_.of), moved ? with_one : with_other},
                       joint.joint);
    const BlockIndex made = block("column-between", joint, relation_.with_respect_to, base);
    context_.closure(
        "jacobian-column" + s + "-between",
        {between_.pose(relation_.with_respect_to, relation_.of), with_one, with_other, made},
        joint.joint);
    if (relation_.seen_by == base) return made;
    const BlockIndex turned =
        block("column-seen", joint, relation_.with_respect_to, relation_.seen_by);
    context_.closure("rotate-jacobian-column" + s + "-to-distal",
                     {between_.pose(base, relation_.seen_by), made, turned}, joint.joint);
    return turned;
  }

  Context& context_;
  const Relation& relation_;
  WayBetween way_;
  Between between_{context_};
};

// Puts columns together to a matrix of so many rows.
void assemble(Context& context, std::string_view operation, std::vector<BlockIndex> columns,
              BlockSpec spec, std::uint32_t rows, Id about) {
  std::uint32_t count = 0;
  for (const BlockIndex column : columns) count += context.builder.at(column).size / rows;
  spec.size = rows * count;
  const auto blocks = static_cast<std::uint32_t>(columns.size());
  columns.push_back(context.make(spec));
  if (count != blocks)
    context.closure_with_counts("floating-" + std::string(operation), std::move(columns),
                                {1, blocks - 1, 1}, about);
  else
    context.closure_with_counts(operation, std::move(columns), {blocks, 1}, about);
}

void make_jacobian(Context& context, const Relation& relation) {
  BlockSpec spec = pose_output(relation, "jacobian", "jacobian");
  spec.reference = relation.of;
  spec.seen_by = relation.seen_by;
  assemble(context, "jacobian-from-columns", Columns(context, relation).make(), spec, 6,
           relation.of);
}

void make_analytic_jacobian(Context& context, const Relation& relation) {
  Between between(context);
  const BlockIndex coordinates =
      context.make(pose_output(relation, "coordinates-of-pose", "position-and-quaternion"));
  context.closure("position-and-quaternion-from-pose",
                  {between.pose(relation.with_respect_to, relation.of), coordinates}, relation.of);
  std::vector<BlockIndex> columns;
  for (const BlockIndex column : Columns(context, relation).make()) {
    const bool block = context.builder.at(column).size != 6;
    BlockSpec spec = pose_output(relation, "quaternion-column",
                                 block ? "quaternion-block" : "quaternion-column");
    spec.represents = context.builder.at(column).represents;
    spec.prismatic = context.builder.at(column).unit.starts_with("PER-M");
    columns.push_back(context.make(spec));
    context.closure(block ? "quaternion-columns-from-jacobian-columns"
                          : "quaternion-column-from-jacobian-column",
                    {coordinates, column, columns.back()}, relation.of);
  }
  assemble(context, "analytic-jacobian-from-columns", std::move(columns),
           pose_output(relation, "analytic-jacobian", "analytic-jacobian"), 7, relation.of);
}

Step between_step(const std::string& quantity, const std::string& gives, std::string purpose,
                  std::vector<std::string> needs, std::vector<std::string> may_use,
                  void (*make)(Context&, const Relation&)) {
  needs.insert(needs.begin(), {"placement", "pose-across-joint"});
  may_use.insert(may_use.end(), {"pose", "frame-pose"});
  Step step = at_root(gives, std::move(purpose), std::move(needs), gives, {},
                      [quantity, make](Context& context, const Visit&) {
                        for (const Relation& relation : context.relations)
                          if (relation.quantity == quantity) make(context, relation);
                      });
  step.may_use = std::move(may_use);
  return step;
}

}  // namespace

std::vector<Step> between_steps() {
  const std::vector<std::string> motions = {"body-twist", "body-acceleration",
                                            "bias-body-acceleration", "base-acceleration"};
  return {
      between_step("pose", "pose-between", "what lies between two frames", {}, {}, make_pose),
      between_step("position-and-quaternion", "position-and-quaternion",
                   "a pose in seven numbers, those of a floating base", {}, {}, make_coordinates),
      between_step("twist", "twist-between", "the twists of two frames, one without the other",
                   {"relative-twist"}, motions, make_twist),
      between_step("acceleration-twist", "acceleration-between",
                   "accelerations of two frames, one without what the other carries along",
                   {"relative-twist", "relative-acceleration"}, motions, make_acceleration),
      between_step("jacobian-rate-times-velocity", "jacobian-rate-times-velocity",
                   "what accelerates while no joint does", {"relative-twist"}, motions, make_rate),
      between_step("jacobian", "jacobian-between",
                   "each joint between two frames moves one of them", {}, {}, make_jacobian),
      between_step("analytic-jacobian", "analytic-jacobian",
                   "derivatives of position and quaternion by the joints' positions", {}, {},
                   make_analytic_jacobian),
  };
}

}  // namespace sinew::synthesis
