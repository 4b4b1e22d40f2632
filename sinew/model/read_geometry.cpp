// Links, frames, poses and positions: what the geometry metamodels say.
#include <fmt/format.h>

#include <map>

#include "sinew/model/rotation.h"
#include "sinew/model/structure_reader.h"

namespace sinew::model {
namespace {

int add_frame(GraphReader& reader, Structure& structure, Id iri, int link) {
  const int index = static_cast<int>(structure.frames.size());
  const Id origin = reader.at_most_one(iri, reader.ids.origin, "the frame's origin");
  structure.frames.push_back({iri, origin, link});
  structure.frame_by_iri.emplace(iri, index);
  if (origin) structure.frames_at[origin].push_back(index);
  return index;
}

// The relation (Pose, Position, …) of a coordinate node: a node of its own, or the same node.
Id relation_of(GraphReader& reader, Id coordinate, Id property, std::string_view what) {
  if (!reader.has(coordinate, property) && reader.has(coordinate, reader.ids.of)) {
    return coordinate;
  }
  return reader.one(coordinate, property, what).value_or(Id{});
}

// A stated rotation, made orthonormal; nothing where it is none.
std::optional<Matrix3> read_rotation(GraphReader& reader, Id node) {
  const auto R = reader.direction_cosines(node);
  if (!R) return std::nullopt;
  const double error = orthonormality_error(*R);
  if (error > kOrthonormalError) {
    reader.error(node, reader.ids.cosine_x,
                 error >= 2
                     ? "the direction cosines are no right-handed frame"
                     : fmt::format("the direction cosines are off a rotation by {:.2g}", error),
                 "give three orthogonal unit vectors, the axes of the frame: x, y, and z = x x y");
    return std::nullopt;
  }
  if (error > kOrthonormalWarning) {
    reader.warning(node, reader.ids.cosine_x,
                   fmt::format("the direction cosines are off a rotation by {:.2g}", error),
                   "the nearest rotation is used; write more digits");
  }
  return error > kOrthonormalRoundOff ? nearest_rotation(*R) : *R;
}

std::optional<Vector3> read_vector(GraphReader& reader, Id node, std::string_view what) {
  const auto scale = reader.scale(node, dimension::kLength, what);
  const auto v = reader.vector(node, reader.ids.x, reader.ids.y, reader.ids.z);
  if (!scale || !v) return std::nullopt;
  return *scale * *v;
}

bool states_vector(const GraphReader& reader, Id node) {
  return reader.has(node, reader.ids.x) || reader.has(node, reader.ids.y) ||
         reader.has(node, reader.ids.z);
}

bool states_rotation(const GraphReader& reader, Id node) {
  return reader.has(node, reader.ids.cosine_x) || reader.has(node, reader.ids.cosine_y) ||
         reader.has(node, reader.ids.cosine_z);
}

void read_pose_coordinates(GraphReader& reader, Structure& structure) {
  const Ids& ids = reader.ids;
  for (const Id node : reader.all(ids.pose_coordinate)) {
    const bool rotation = states_rotation(reader, node), position = states_vector(reader, node);
    if (!rotation && !position) continue;  // a pose that something else computes
    const Id pose = relation_of(reader, node, ids.of_pose, "the pose that the coordinates are of");
    if (!pose) continue;
    const int of = frame_of(reader, structure, pose, ids.of, "the frame whose pose this is");
    const int wrt = frame_of(reader, structure, pose, ids.with_respect_to,
                             "the frame with respect to which this pose is");
    const int seen_by = frame_of(reader, structure, node, ids.seen_by,
                                 "the frame from which the coordinates are seen");
    const auto R = read_rotation(reader, node);
    const auto p = read_vector(reader, node, "the position");
    if (of == kNone || wrt == kNone || seen_by == kNone || !R || !p) continue;
    if (seen_by != wrt) {
      reader.error(node, ids.seen_by,
                   fmt::format("the coordinates are seen by <{}>, but the pose is with respect to "
                               "<{}>",
                               reader.text(structure.frames[seen_by].iri),
                               reader.text(structure.frames[wrt].iri)),
                   "see a pose's coordinates from the frame with respect to which it is");
      continue;
    }
    structure.poses.push_back({node, of, wrt, {*R, *p}});
  }
}

void read_position_coordinates(GraphReader& reader, Structure& structure) {
  const Ids& ids = reader.ids;
  for (const Id node : reader.all(ids.position_coordinate)) {
    if (!states_vector(reader, node)) continue;
    const Id position =
        relation_of(reader, node, ids.of_position, "the position that the coordinates are of");
    if (!position) continue;
    const auto of = reader.one(position, ids.of, "the point whose position this is");
    const auto wrt = reader.one(position, ids.with_respect_to,
                                "the point with respect to which this position is");
    const int seen_by = frame_of(reader, structure, node, ids.seen_by,
                                 "the frame from which the coordinates are seen");
    const auto p = read_vector(reader, node, "the position");
    if (of && wrt && seen_by != kNone && p) {
      structure.positions.push_back({node, *of, *wrt, seen_by, *p});
    }
  }
}

// Where the origin of frame `of` is in frame `wrt`, which is turned by R against it: what a
// position says that is of either origin with respect to the other one and seen by either frame.
std::optional<Vector3> position_between(const Structure& structure, int of, int wrt,
                                        const Matrix3& R) {
  const Id here = structure.frames[of].origin, there = structure.frames[wrt].origin;
  if (here && here == there) return Vector3{0, 0, 0};
  for (const Structure::Position& p : structure.positions) {
    const bool forward = p.of == here && p.with_respect_to == there;
    const bool backward = p.of == there && p.with_respect_to == here;
    if ((!forward && !backward) || (p.seen_by != wrt && p.seen_by != of)) continue;
    const Vector3 seen_by_wrt = p.seen_by == wrt ? p.position : R * p.position;
    return forward ? seen_by_wrt : -seen_by_wrt;
  }
  return std::nullopt;
}

// An orientation of one frame in another, and a position of their origins, make a pose.
void read_orientation_coordinates(GraphReader& reader, Structure& structure) {
  const Ids& ids = reader.ids;
  for (const Id node : reader.all(ids.orientation_coordinate)) {
    if (!states_rotation(reader, node)) continue;
    const Id relation = relation_of(reader, node, ids.of_orientation,
                                    "the orientation that the coordinates are of");
    if (!relation) continue;
    const int of = frame_of(reader, structure, relation, ids.of, "the frame that is oriented");
    const int wrt = frame_of(reader, structure, relation, ids.with_respect_to,
                             "the frame with respect to which it is oriented");
    const auto R = read_rotation(reader, node);
    if (of == kNone || wrt == kNone || !R) continue;
    if (const auto p = position_between(structure, of, wrt, *R)) {
      structure.poses.push_back({node, of, wrt, {*R, *p}});
    } else {
      reader.warning(node, ids.of_orientation,
                     fmt::format("no position of the origin of <{}> with respect to that of <{}> "
                                 "is seen by one of the two frames; the orientation places nothing",
                                 reader.text(structure.frames[of].iri),
                                 reader.text(structure.frames[wrt].iri)),
                     "state a PositionCoordinate of it as well, or a PoseCoordinate");
    }
  }
}

}  // namespace

int frame_of(GraphReader& reader, Structure& structure, Id node, Id property,
             std::string_view what) {
  const auto iri = reader.one(node, property, what);
  if (!iri) return kNone;
  const int known = structure.find_frame(*iri);
  if (known != kNone) return known;
  if (reader.is_a(*iri, reader.ids.frame)) return add_frame(reader, structure, *iri, kNone);
  reader.error(node, property,
               fmt::format("{} is <{}>, which no model says is a frame", what, reader.text(*iri)),
               "name a Frame of these models, or load the model that has it as well");
  return kNone;
}

void read_links_and_frames(GraphReader& reader, Structure& structure) {
  const Ids& ids = reader.ids;
  for (const Id link : reader.all(ids.link)) {
    const int index = static_cast<int>(structure.links.size());
    structure.links.push_back({link, {}});
    structure.link_by_iri.emplace(link, index);
    for (const Id simplex : reader.objects(link, ids.simplices)) {
      const auto [owner, fresh] = structure.link_of_point.emplace(simplex, index);
      if (!fresh) {
        reader.error(link, ids.simplices,
                     fmt::format("<{}> belongs to <{}> already", reader.text(simplex),
                                 reader.text(structure.links[owner->second].iri)),
                     "let every simplex belong to one link");
      } else if (reader.is_a(simplex, ids.frame)) {
        structure.links[index].frames.push_back(add_frame(reader, structure, simplex, index));
      }
    }
  }
}

void read_poses(GraphReader& reader, Structure& structure) {
  read_pose_coordinates(reader, structure);
  read_position_coordinates(reader, structure);
  read_orientation_coordinates(reader, structure);
}

}  // namespace sinew::model
