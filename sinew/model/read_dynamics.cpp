// Inertias, and the acceleration of the base that stands for gravity.
#include <fmt/format.h>

#include "sinew/model/structure_reader.h"

namespace sinew::model {
namespace {

// The frame of `as-seen-by`, of whichever metamodel's context has defined it.
int seen_by(GraphReader& reader, Structure& structure, Id node, std::string_view what) {
  const Ids& ids = reader.ids;
  const bool dynamics = reader.has(node, ids.inertia_seen_by);
  return frame_of(reader, structure, node, dynamics ? ids.inertia_seen_by : ids.seen_by, what);
}

// Null for an inertia of nothing, which is an error where it is placed; nothing, and an error, for
// one of several bodies.
std::optional<Id> body_of(GraphReader& reader, Id inertia) {
  const Ids& ids = reader.ids;
  std::vector<Id> bodies = reader.objects(inertia, ids.of_body);
  for (const Id body : reader.objects(inertia, ids.inertia_of)) bodies.push_back(body);
  for (const Id body : bodies) {
    if (body == bodies.front()) continue;
    reader.error(inertia, ids.of_body,
                 fmt::format("the inertia is of <{}> and of <{}>", reader.text(bodies.front()),
                             reader.text(body)),
                 "let it be of-body one link");
    return std::nullopt;
  }
  return bodies.empty() ? Id{} : bodies.front();
}

void read_inertia(GraphReader& reader, Structure& structure, Id node) {
  const Ids& ids = reader.ids;
  if (!states_inertia(reader, node)) return;  // computed elsewhere
  const Id inertia =
      reader.has(node, ids.of_inertia)
          ? reader.one(node, ids.of_inertia, "the inertia that the coordinates are of")
                .value_or(Id{})
          : node;
  if (!inertia) return;
  const auto about = reader.one(inertia, ids.about, "the point about which the inertia is");
  const int frame = seen_by(reader, structure, node, "the frame from which the inertia is seen");
  const auto mass_scale = reader.scale(node, dimension::kMass, "the mass");
  const auto moment_scale = reader.scale(node, dimension::kFirstMoment, "the first moment of mass");
  const auto inertia_scale = reader.scale(node, dimension::kInertia, "the moments of inertia");
  const auto mass = reader.number(node, ids.mass);
  const auto h = reader.list_of_three(node, ids.first_moment);
  const auto diagonal = reader.vector(node, ids.ixx, ids.iyy, ids.izz);
  const auto products = reader.vector(node, ids.ixy, ids.ixz, ids.iyz);
  const auto body = body_of(reader, inertia);
  if (!body || !about || frame == kNone || !mass_scale || !moment_scale || !inertia_scale ||
      !mass || !h || !diagonal || !products) {
    return;
  }
  const double s = *inertia_scale;
  Structure::Inertia facts;
  facts.coordinate = node;
  facts.link = *body;
  facts.about = *about;
  facts.seen_by = frame;
  facts.value.mass = *mass_scale * *mass;
  facts.value.first_moment = *moment_scale * *h;
  facts.value.rotational = {s * diagonal->x, s * products->x, s * products->y,
                            s * diagonal->y, s * products->z, s * diagonal->z};
  structure.inertias.push_back(facts);
}

std::optional<Vector3> part(GraphReader& reader, Id node, Id property,
                            const data::Dimension& dimension, std::string_view what) {
  const auto value = reader.list_of_three(node, property);
  const auto scale = reader.scale(node, dimension, what);
  if (!value || !scale) return std::nullopt;
  return *scale * *value;
}

void read_acceleration(GraphReader& reader, Structure& structure, Id node) {
  const Ids& ids = reader.ids;
  if (!reader.has(node, ids.linear_acceleration) && !reader.has(node, ids.angular_acceleration)) {
    return;  // computed elsewhere
  }
  const Id relation =
      reader.has(node, ids.of_acceleration)
          ? reader.at_most_one(node, ids.of_acceleration, "the acceleration of the coordinates")
          : node;
  if (!relation) return;
  const auto of = reader.one(relation, ids.of, "the body that accelerates");
  const auto wrt =
      reader.one(relation, ids.with_respect_to, "the body with respect to which it accelerates");
  const auto point = reader.one(relation, ids.reference_point, "the point that accelerates");
  const int frame = seen_by(reader, structure, node, "the frame from which it is seen");
  const auto angular = part(reader, node, ids.angular_acceleration, dimension::kAngularAcceleration,
                            "the angular acceleration");
  const auto linear = part(reader, node, ids.linear_acceleration, dimension::kAcceleration,
                           "the linear acceleration");
  if (!of || !wrt || !point || frame == kNone || !angular || !linear) return;
  structure.base_accelerations.push_back({node, *of, *wrt, *point, frame, {*angular, *linear}});
}

// A model may state that its base rests; that it moves is for the query to say.
void check_velocity(GraphReader& reader, Id node) {
  const Ids& ids = reader.ids;
  for (const Id property : {ids.angular_velocity, ids.linear_velocity}) {
    if (!reader.has(node, property)) continue;
    const auto value = reader.list_of_three(node, property);
    if (value && dot(*value, *value) > 0) {
      reader.error(node, property, "the model states a velocity that is not zero",
                   "leave velocities to the query (a floating base has them as inputs)");
    }
  }
}

}  // namespace

bool states_inertia(const GraphReader& reader, Id node) {
  const Ids& ids = reader.ids;
  for (const Id number :
       {ids.mass, ids.first_moment, ids.ixx, ids.iyy, ids.izz, ids.ixy, ids.ixz, ids.iyz}) {
    if (reader.has(node, number)) return true;
  }
  return false;
}

void read_inertias(GraphReader& reader, Structure& structure) {
  const Ids& ids = reader.ids;
  for (const Id node : reader.all(ids.inertia_coordinate)) read_inertia(reader, structure, node);
  for (const Id node : reader.all(ids.inertia)) {
    if (!reader.has(node, ids.legacy_mass) && !reader.has(node, ids.legacy_xx)) continue;
    reader.warning(node, ids.legacy_mass,
                   "the inertia states no first moment of mass and no centre of mass; the link "
                   "counts as one without mass",
                   "state it with a RigidBodyInertiaCoordinate before asking for dynamics");
  }
}

void read_base_accelerations(GraphReader& reader, Structure& structure) {
  for (const Id node : reader.all(reader.ids.acceleration_twist_coordinate)) {
    read_acceleration(reader, structure, node);
  }
  for (const Id node : reader.all(reader.ids.velocity_twist_coordinate)) {
    check_velocity(reader, node);
  }
}

}  // namespace sinew::model
