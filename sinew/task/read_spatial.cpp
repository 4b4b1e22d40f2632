#include <fmt/format.h>

#include "sinew/task/reader.h"
#include "sinew/vocab/vocab.h"

namespace sinew::task {
namespace {

namespace map = vocab::map;

// A published kind of view: of which coordinates, and the names of its subspaces.
struct ViewRow {
  std::string_view type;
  SpatialKind kind;
  std::string_view angular, linear;  // a pose's has only the latter
};
constexpr ViewRow kViews[] = {
    {map::PoseCoordinateView, SpatialKind::kPose, {}, map::position},
    {map::VelocityTwistCoordinateView, SpatialKind::kVelocityTwist, map::angular_velocity,
     map::linear_velocity},
    {map::AccelerationTwistCoordinateView, SpatialKind::kAccelerationTwist,
     map::angular_acceleration, map::linear_acceleration},
    {map::WrenchCoordinateView, SpatialKind::kWrench, map::torque, map::force},
};

std::string_view short_name(std::string_view iri) { return iri.substr(iri.rfind('#') + 1); }

void read_view(Reader& reader, Id node, const ViewRow& row) {
  View view;
  view.id = node;
  view.spatial = reader.required(node, map::superobject, "what the view is of");
  view.number = reader.number(node, map::subobject, "the view's number");
  const Id subspace = reader.required(node, map::subspace, "the view's subspace");
  const Id axis = reader.required(node, map::axis, "the view's axis (x, y or z)");
  if (!view.spatial || !view.number || !subspace || !axis) return;
  if (subspace == reader.iri(row.linear)) {
    view.subspace = row.angular.empty() ? Subspace::kPosition : Subspace::kLinear;
  } else if (!row.angular.empty() && subspace == reader.iri(row.angular)) {
    view.subspace = Subspace::kAngular;
  } else {
    reader.error(node, map::subspace,
                 fmt::format("<{}> is no subspace of it", reader.graph.text(subspace)),
                 row.angular.empty()
                     ? fmt::format("{}", short_name(row.linear))
                     : fmt::format("{} or {}", short_name(row.angular), short_name(row.linear)));
    return;
  }
  const std::string_view axes[] = {map::x, map::y, map::z};
  for (view.axis = 0; view.axis < 3; ++view.axis)
    if (axis == reader.iri(axes[view.axis])) break;
  if (view.axis == 3) {
    reader.error(node, map::axis, fmt::format("<{}> is no axis", reader.graph.text(axis)),
                 "x, y or z");
    return;
  }
  if (!read_spatial(reader, view.spatial)) return;
  if (reader.task.spatials.at(view.spatial).kind != row.kind) {
    reader.error(node, map::superobject, "the view is of another kind of coordinates",
                 fmt::format("a {} is of a {}", short_name(row.type),
                             short_name(row.type).substr(0, short_name(row.type).size() - 4)));
    return;
  }
  reader.task.views.push_back(view);
}

// Which relation the coordinates are of, and where its properties are.
struct SpatialRow {
  SpatialKind kind;
  std::string_view type, relation, of, wrt, seen_by;
};
constexpr SpatialRow kSpatial[] = {
    {SpatialKind::kPose, vocab::geom_coord::PoseCoordinate, vocab::geom_coord::of_pose,
     vocab::geom_rel::of, vocab::geom_rel::with_respect_to, vocab::geom_coord::as_seen_by},
    {SpatialKind::kVelocityTwist, vocab::geom_coord::VelocityTwistCoordinate,
     vocab::geom_coord::of_velocity, vocab::geom_rel::of, vocab::geom_rel::with_respect_to,
     vocab::geom_coord::as_seen_by},
    {SpatialKind::kAccelerationTwist, vocab::geom_coord::AccelerationTwistCoordinate,
     vocab::geom_coord::of_acceleration, vocab::geom_rel::of, vocab::geom_rel::with_respect_to,
     vocab::geom_coord::as_seen_by},
    {SpatialKind::kWrench,
     vocab::dyn_coord::WrenchCoordinate,
     vocab::dyn_coord::of_wrench,
     vocab::dyn_ent::acts_on,
     {},
     vocab::dyn_coord::as_seen_by},
};

void read_constant_pose(Reader& reader, Spatial& spatial) {
  const auto R = reader.graph.direction_cosines(spatial.id);
  const auto& ids = reader.graph.ids;
  const auto p = reader.graph.vector(spatial.id, ids.x, ids.y, ids.z);
  const auto scale =
      reader.graph.scale(spatial.id, model::dimension::kLength, "the pose's position");
  if (!R || !p || !scale) return;
  spatial.value = {R->xx, R->xy,         R->xz, p->x * *scale, R->yx, R->yy,
                   R->yz, p->y * *scale, R->zx, R->zy,         R->zz, p->z * *scale};
}

}  // namespace

bool read_spatial(Reader& reader, Id coordinates) {
  if (reader.task.spatials.contains(coordinates)) return true;
  const SpatialRow* row = nullptr;
  for (const SpatialRow& one : kSpatial)
    if (reader.is_a(coordinates, one.type)) row = &one;
  if (row == nullptr) {
    reader.error(coordinates, "", "these are coordinates of no pose, twist or wrench",
                 "give them the type PoseCoordinate, VelocityTwistCoordinate, "
                 "AccelerationTwistCoordinate or WrenchCoordinate");
    return false;
  }
  Spatial spatial;
  spatial.id = coordinates;
  spatial.kind = row->kind;
  const Id relation = reader.required(coordinates, row->relation, "what the coordinates are of");
  if (!relation) return false;
  spatial.seen_by =
      reader.required(coordinates, row->seen_by, "the frame that the coordinates are seen by");
  spatial.of = reader.required(
      relation, row->of,
      row->kind == SpatialKind::kPose ? "the frame that is posed" : "the link that it is of");
  if (!row->wrt.empty())
    spatial.wrt = reader.required(relation, row->wrt, "what it is with respect to");
  if (row->kind != SpatialKind::kPose)
    spatial.reference =
        row->kind == SpatialKind::kWrench
            ? reader.required(relation, vocab::dyn_ent::reference_point, "its reference point")
            : reader.required(relation, vocab::geom_rel::reference_point, "its reference point");
  if (!spatial.seen_by || !spatial.of || (!row->wrt.empty() && !spatial.wrt) ||
      (row->kind != SpatialKind::kPose && !spatial.reference))
    return false;
  spatial.setpoint = reader.is_a(coordinates, vocab::st::Setpoint);
  if (row->kind == SpatialKind::kPose && reader.graph.has(coordinates, reader.graph.ids.cosine_x))
    read_constant_pose(reader, spatial);
  reader.task.spatials.emplace(coordinates, spatial);
  return true;
}

std::optional<JointKind> read_joint_kind(Reader& reader, Id coordinates) {
  constexpr std::pair<std::string_view, JointKind> kTypes[] = {
      {vocab::kc_stat::JointPositionCoordinate, JointKind::kPosition},
      {vocab::kc_stat::JointVelocityCoordinate, JointKind::kVelocity},
      {vocab::kc_stat::JointAccelerationCoordinate, JointKind::kAcceleration},
      {vocab::kc_stat::JointForceCoordinate, JointKind::kForce}};
  for (const auto& [type, kind] : kTypes)
    if (reader.is_a(coordinates, type)) return kind;
  return std::nullopt;
}

void read_views(Reader& reader) {
  for (const ViewRow& row : kViews)
    for (const Id node : reader.graph.all(reader.iri(row.type))) read_view(reader, node, row);
  for (const Id node : reader.graph.all(reader.iri(vocab::st::JointCoordinateView))) {
    JointView view;
    view.id = node;
    view.coordinates = reader.required(node, map::superobject, "what the view is of");
    view.number = reader.number(node, map::subobject, "the view's number");
    if (!view.coordinates || !view.number) continue;
    const auto kind = read_joint_kind(reader, view.coordinates);
    if (!kind) {
      reader.error(view.coordinates, "", "these are coordinates of no joint",
                   "give them the type JointPositionCoordinate, JointVelocityCoordinate, "
                   "JointAccelerationCoordinate or JointForceCoordinate");
      continue;
    }
    view.kind = *kind;
    view.joint = reader.required(view.coordinates, vocab::kc_stat::of_joint, "the joint");
    if (view.joint) reader.task.joint_views.push_back(view);
  }
}

}  // namespace sinew::task
