// Joints: what they connect, about or along which axis, which way, and how far.
#include <fmt/format.h>

#include <cmath>

#include "sinew/model/read_joints.h"
#include "sinew/model/structure_reader.h"

namespace sinew::model {
namespace {

// How far an axis may be from a unit vector, and an offset from the axis, to count as written so.
constexpr double kAxisTolerance = 1e-6;

std::optional<JointKind> read_kind(GraphReader& reader, Id joint) {
  const Ids& ids = reader.ids;
  std::string kinds;
  int count = 0;
  for (const Id kind : joint_types(ids)) {
    if (!reader.is_a(joint, kind)) continue;
    kinds += fmt::format("{}<{}>", count++ ? ", " : "", reader.text(kind));
  }
  if (count > 1) {
    reader.error(joint, ids.type, fmt::format("the joint is of {} kinds: {}", count, kinds),
                 "let it be of one kind; motions one after the other are a CompositeJoint's");
    return std::nullopt;
  }
  if (reader.is_a(joint, ids.revolute)) return JointKind::kRevolute;
  if (reader.is_a(joint, ids.prismatic)) return JointKind::kPrismatic;
  if (reader.is_a(joint, ids.fixed)) return JointKind::kFixed;
  if (const auto kind = compound_kind(reader, joint)) return kind;
  reader.error(joint, ids.type, "nothing says how the joint moves",
               "make it a RevoluteJoint, PrismaticJoint, HelicalJoint, CylindricalJoint, "
               "PlanarJoint, UniversalJoint, SphericalJoint, FloatingJoint, CompositeJoint or "
               "FixedJoint as well");
  return std::nullopt;
}

// The two attachments, which must be frames of links.
std::optional<std::pair<int, int>> read_attachments(GraphReader& reader, const Structure& structure,
                                                    Id joint) {
  const Ids& ids = reader.ids;
  const std::vector<Id> attachments = reader.objects(joint, ids.between_attachments);
  if (attachments.size() != 2) {
    reader.error(joint, ids.between_attachments,
                 fmt::format("the joint has {} attachments", attachments.size()),
                 "name two frames, one of each link that it connects, in between-attachments");
    return std::nullopt;
  }
  int frames[2] = {};
  for (int i = 0; i < 2; ++i) {
    frames[i] = structure.find_frame(attachments[i]);
    if (frames[i] == kNone || structure.frames[frames[i]].link == kNone) {
      reader.error(
          joint, ids.between_attachments,
          fmt::format("the attachment <{}> is no frame of any link", reader.text(attachments[i])),
          "name a Frame that is among the simplices of a link (SimplicialComplex)");
      return std::nullopt;
    }
  }
  return std::pair{frames[0], frames[1]};
}

struct Direction {
  Vector3 along;
  Id coordinate = {};  // that states it; null for an axis of the frame
};

// The direction of `line` seen from `frame`, where the model states it: as one of the frame's axes
// (also when the vector says so of itself, and starts at the frame's origin), or in coordinates.
std::optional<Direction> line_direction(GraphReader& reader, const Structure::Frame& frame,
                                        Id line) {
  const Ids& ids = reader.ids;
  const Id vectors[3] = {ids.vector_x, ids.vector_y, ids.vector_z};
  const Vector3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const bool starts_here = frame.origin && reader.view.contains(line, ids.start, frame.origin);
  for (int i = 0; i < 3; ++i) {
    const bool is_axis = reader.view.contains(frame.iri, vectors[i], line) ||
                         (starts_here && reader.view.contains(line, vectors[i], line));
    if (is_axis) return Direction{axes[i]};
  }
  std::optional<Direction> direction;
  reader.view.match({}, ids.of_direction, line, graph::Dataset::kUnion, [&](const graph::Quad& q) {
    if (!reader.view.contains(q.subject, ids.seen_by, frame.iri)) return true;
    const auto scale = reader.scale(q.subject, dimension::kNone, "the direction");
    const auto along = reader.vector(q.subject, ids.x, ids.y, ids.z);
    if (scale && along) direction = Direction{*scale * *along, q.subject};
    return !direction;
  });
  return direction;
}

}  // namespace

std::optional<Vector3> read_axis(GraphReader& reader, const Structure& structure, Id joint,
                                 const Structure::Joint& facts) {
  const Ids& ids = reader.ids;
  const auto axis = reader.one(joint, ids.common_axis, "the joint's axis");
  if (!axis) return std::nullopt;
  const std::vector<Id> lines = reader.objects(*axis, ids.lines);
  std::optional<Direction> directions[2];
  const int frames[2] = {facts.parent, facts.child};
  for (int i = 0; i < 2; ++i) {
    const Structure::Frame& frame = structure.frames[frames[i]];
    for (const Id line : lines) {
      directions[i] = line_direction(reader, frame, line);
      if (directions[i]) break;
    }
    if (!directions[i]) {
      const bool stated = !lines.empty();
      reader.error(
          stated ? *axis : joint, stated ? ids.lines : ids.common_axis,
          fmt::format("none of the lines of <{}> has a known direction in the attachment <{}> of "
                      "<{}>",
                      reader.text(*axis), reader.text(frame.iri), reader.text(joint)),
          "let one line be vector-x, vector-y or vector-z of each attachment");
      return std::nullopt;
    }
  }
  const auto length = [](const Vector3& v) { return std::sqrt(dot(v, v)); };
  const auto refuse = [&](const Direction& direction, std::string what) {
    const Id node = direction.coordinate ? direction.coordinate : *axis;
    reader.error(node, direction.coordinate ? ids.x : ids.lines,
                 fmt::format("the axis of <{}> {}", reader.text(joint), what),
                 "give a unit vector: the direction about or along which the joint moves");
    return std::nullopt;
  };
  for (const auto& direction : directions) {
    const double size = length(direction->along);
    if (size == 0) return refuse(*direction, "has no length");
    if (std::abs(size - 1) > 1e-3) return refuse(*direction, fmt::format("has length {}", size));
  }
  if (length(directions[0]->along - directions[1]->along) > kAxisTolerance) {
    reader.error(*axis, ids.lines,
                 "the axis is another direction in one attachment than in the other, so that joint "
                 "position zero is not defined",
                 "use the same axis of both attachments");
    return std::nullopt;
  }
  if (reader.objects(joint, ids.polarity).size() > 1) {
    reader.error(joint, ids.polarity, "the joint has two polarities",
                 "write PositivePolarity or NegativePolarity");
    return std::nullopt;
  }
  const Id polarity = reader.view.object(joint, ids.polarity);
  if (polarity && polarity != ids.positive && polarity != ids.negative) {
    reader.error(joint, ids.polarity, fmt::format("<{}> is no polarity", reader.text(polarity)),
                 "write PositivePolarity or NegativePolarity");
    return std::nullopt;
  }
  const double sign = polarity == ids.negative ? -1 : 1;
  // An axis of a frame stays exactly that; others are made unit vectors.
  const double size = length(directions[0]->along);
  return (size == 1 ? sign : sign / size) * directions[0]->along;
}

namespace {

// Which attachment is the parent: the offset is the child's origin with respect to the parent's.
void read_direction(GraphReader& reader, const Structure& structure, Structure::Joint& joint) {
  const Ids& ids = reader.ids;
  const Id offset = reader.at_most_one(joint.iri, ids.origin_offset, "the joint's offset");
  if (!offset) return;
  const Id of = reader.at_most_one(offset, ids.of, "the point whose position the offset is");
  const Id wrt = reader.at_most_one(offset, ids.with_respect_to,
                                    "the point with respect to which the offset is");
  const Id parent = structure.frames[joint.parent].origin;
  const Id child = structure.frames[joint.child].origin;
  if (!of || of == wrt) return;
  if (of == child && wrt == parent) {
    joint.directed = true;
  } else if (of == parent && wrt == child) {
    std::swap(joint.parent, joint.child);
    joint.directed = true;
  } else {
    reader.error(joint.iri, ids.origin_offset,
                 "the offset is not the position of one attachment's origin with respect to the "
                 "other's",
                 "let it be of the child attachment's origin, with respect to the parent's");
  }
}

// The coordinates of the joint's offset, if it has any that its attachments see; those of several
// contradict each other or say the same twice.
const Structure::Position* stated_offset(GraphReader& reader, const Structure& structure,
                                         const Structure::Joint& joint) {
  const Ids& ids = reader.ids;
  const Id offset = reader.view.object(joint.iri, ids.origin_offset);
  if (!offset) return nullptr;
  const Structure::Position* stated = nullptr;
  for (const Structure::Position& position : structure.positions) {
    const Id relation = reader.view.object(position.coordinate, ids.of_position);
    if ((relation ? relation : position.coordinate) != offset) continue;
    if (position.seen_by != joint.parent && position.seen_by != joint.child) {
      reader.error(position.coordinate, ids.seen_by,
                   "the joint's offset is seen by neither of its attachments",
                   "see it by the parent attachment");
      return nullptr;
    }
    if (stated) {
      reader.error(position.coordinate, ids.of_position,
                   fmt::format("the offset of <{}> has coordinates already, <{}>",
                               reader.text(joint.iri), reader.text(stated->coordinate)),
                   "state them once");
      return nullptr;
    }
    stated = &position;
  }
  return stated;
}

// The constant offset of the child's origin along the axis, where it has coordinates.
void read_offset(GraphReader& reader, const Structure& structure, Structure::Joint& joint) {
  const Structure::Position* stated = stated_offset(reader, structure, joint);
  if (!stated) return;
  const double along = dot(stated->position, joint.axis);
  const Vector3 aside = stated->position - along * joint.axis;
  if (dot(aside, aside) > kAxisTolerance * kAxisTolerance) {
    reader.error(stated->coordinate, reader.ids.x, "the joint's offset leaves its axis",
                 "put an offset aside the axis into the pose of an attachment");
    return;
  }
  joint.offset = along;
}

// What a fixed joint's offset has coordinates for is the pose of its child, which is not turned;
// where the model states that pose as well, the two are compared when all frames have a place.
void read_fixed_offset(GraphReader& reader, Structure& structure, const Structure::Joint& joint) {
  const Structure::Position* stated = stated_offset(reader, structure, joint);
  if (!stated) return;
  for (const Structure::ConstantPose& pose : structure.poses) {
    const bool both = (pose.of == joint.parent && pose.with_respect_to == joint.child) ||
                      (pose.of == joint.child && pose.with_respect_to == joint.parent);
    if (both) return;
  }
  const Pose pose = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, stated->position};
  structure.poses.push_back({stated->coordinate, joint.child, joint.parent, pose});
}

}  // namespace

void read_joints(GraphReader& reader, Structure& structure) {
  for (const Id node : reader.all(reader.ids.joint)) {
    const auto kind = read_kind(reader, node);
    const auto attachments = read_attachments(reader, structure, node);
    if (!kind || !attachments) continue;
    Structure::Joint joint;
    joint.iri = node;
    joint.kind = *kind;
    std::tie(joint.parent, joint.child) = *attachments;
    read_direction(reader, structure, joint);
    if (has_axis(joint.kind)) {
      const auto axis = read_axis(reader, structure, node, joint);
      if (!axis) continue;
      joint.axis = *axis;
    }
    if (!read_motions(reader, structure, joint)) continue;
    if (joint.kind == JointKind::kFixed) {
      read_fixed_offset(reader, structure, joint);
    } else {
      read_offset(reader, structure, joint);
    }
    structure.joints.push_back(joint);
  }
  read_joint_properties(reader, structure);
}

}  // namespace sinew::model
