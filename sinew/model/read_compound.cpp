// Compound joints: the turns and slides that they are sequences of.
#include <fmt/format.h>

#include "sinew/model/read_joints.h"
#include "sinew/model/rotation.h"

namespace sinew::model {
namespace {

using Motion = Structure::Motion;

constexpr std::size_t kMaximumMotions = 6;

// The nodes of a sequence, in order.
std::optional<std::vector<Id>> read_sequence(GraphReader& reader, Id joint) {
  const Ids& ids = reader.ids;
  const auto head = reader.one(joint, ids.sequence, "the sequence of motions");
  if (!head) return std::nullopt;
  std::vector<Id> nodes;
  for (Id cell = *head; cell && cell != ids.nil; cell = reader.view.object(cell, ids.rest)) {
    const Id node = reader.view.object(cell, ids.first);
    if (!node || nodes.size() == kMaximumMotions) {
      reader.error(joint, ids.sequence,
                   node ? fmt::format("the sequence has more than {} motions", kMaximumMotions)
                        : std::string("the sequence is no list"),
                   fmt::format("list one to {} motions", kMaximumMotions));
      return std::nullopt;
    }
    nodes.push_back(node);
  }
  if (nodes.empty()) {
    reader.error(joint, ids.sequence, "the sequence is empty", "list the joint's motions");
    return std::nullopt;
  }
  return nodes;
}

std::optional<Motion> read_motion(GraphReader& reader, const Structure& structure, Id node,
                                  const Structure::Joint& joint) {
  const Ids& ids = reader.ids;
  const bool turns = reader.is_a(node, ids.revolute_motion);
  if (turns == reader.is_a(node, ids.prismatic_motion)) {
    reader.error(node, ids.type, "nothing says whether this motion turns or slides",
                 "make it either a RevoluteMotion or a PrismaticMotion");
    return std::nullopt;
  }
  const auto axis = read_axis(reader, structure, node, joint);
  if (!axis) return std::nullopt;
  Motion motion;
  motion.iri = node;
  motion.kind = turns ? JointKind::kRevolute : JointKind::kPrismatic;
  motion.axis = *axis;
  return motion;
}

Motion turn(const Vector3& axis) { return {{}, JointKind::kRevolute, axis, false, 1, {}}; }
Motion slide(const Vector3& axis) { return {{}, JointKind::kPrismatic, axis, false, 1, {}}; }

}  // namespace

std::optional<JointKind> compound_kind(const GraphReader& reader, Id joint) {
  const Ids& ids = reader.ids;
  const std::pair<Id, JointKind> kinds[] = {
      {ids.helical, JointKind::kHelical},     {ids.cylindrical, JointKind::kCylindrical},
      {ids.planar, JointKind::kPlanar},       {ids.universal, JointKind::kUniversal},
      {ids.spherical, JointKind::kSpherical}, {ids.floating, JointKind::kFloating},
      {ids.composite, JointKind::kComposite}};
  for (const auto& [type, kind] : kinds) {
    if (reader.is_a(joint, type)) return kind;
  }
  return std::nullopt;
}

std::vector<Id> joint_types(const Ids& ids) {
  return {ids.revolute, ids.prismatic, ids.fixed,     ids.helical,  ids.cylindrical,
          ids.planar,   ids.universal, ids.spherical, ids.floating, ids.composite};
}

bool has_axis(JointKind kind) {
  return kind == JointKind::kRevolute || kind == JointKind::kPrismatic ||
         kind == JointKind::kHelical || kind == JointKind::kCylindrical ||
         kind == JointKind::kPlanar;
}

bool read_motions(GraphReader& reader, const Structure& structure, Structure::Joint& joint) {
  const Vector3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  switch (joint.kind) {
    case JointKind::kFixed:
    case JointKind::kRevolute:
    case JointKind::kPrismatic:
      return true;
    case JointKind::kHelical:
      joint.motions = {turn(joint.axis), slide(joint.axis)};
      joint.motions[1].follows = true;
      joint.motions[1].ratio = JointLimits::kNone;  // until its pitch is read
      return true;
    case JointKind::kCylindrical:
      joint.motions = {turn(joint.axis), slide(joint.axis)};
      return true;
    case JointKind::kPlanar: {
      const Matrix3 R = rotation_with_z(joint.axis);
      joint.motions = {slide({R.xx, R.yx, R.zx}), slide({R.xy, R.yy, R.zy}), turn(joint.axis)};
      return true;
    }
    case JointKind::kSpherical:
      joint.motions = {turn(x), turn(y), turn(z)};
      return true;
    case JointKind::kFloating:
      joint.motions = {turn(x), turn(y), turn(z), slide(x), slide(y), slide(z)};
      return true;
    case JointKind::kUniversal:
    case JointKind::kComposite:
      break;
  }
  const auto nodes = read_sequence(reader, joint.iri);
  if (!nodes) return false;
  for (const Id node : *nodes) {
    const auto motion = read_motion(reader, structure, node, joint);
    if (!motion) return false;
    joint.motions.push_back(*motion);
  }
  const bool two_turns = joint.motions.size() == 2 &&
                         joint.motions[0].kind == JointKind::kRevolute &&
                         joint.motions[1].kind == JointKind::kRevolute;
  if (joint.kind == JointKind::kUniversal && !two_turns) {
    reader.error(joint.iri, reader.ids.sequence, "a universal joint is a sequence of two turns",
                 "list two motions of type RevoluteMotion, or make it a CompositeJoint");
    return false;
  }
  return true;
}

}  // namespace sinew::model
