// Statements that would be passed over in silence, because the node that makes them does not have
// the type by which it is found; and joints that would be used in silence, though chains list
// others.
#include <fmt/format.h>

#include <array>
#include <unordered_map>

#include "sinew/model/read_joints.h"
#include "sinew/model/structure_reader.h"

namespace sinew::model {
namespace {

std::string_view short_name(std::string_view iri) { return iri.substr(iri.find_last_of("/#") + 1); }

// Every subject of that property, once.
std::vector<Id> subjects(const GraphReader& reader, Id property) {
  std::vector<Id> nodes;
  reader.view.match({}, property, {}, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
    if (nodes.empty() || nodes.back() != quad.subject) nodes.push_back(quad.subject);
    return true;
  });
  return nodes;
}

void report_missing_type(GraphReader& reader, Id node, Id property, std::string_view what,
                         Id type) {
  reader.error(node, property,
               fmt::format("{}, but the node is no {}", what, short_name(reader.text(type))),
               fmt::format("add {} to its @type", short_name(reader.text(type))));
}

// Coordinates that say of what they are and state numbers of it.
void check_coordinates(GraphReader& reader) {
  const Ids& ids = reader.ids;
  struct Row {
    Id of, number, type;
  };
  const Row rows[] = {
      {ids.of_pose, ids.cosine_x, ids.pose_coordinate},
      {ids.of_pose, ids.x, ids.pose_coordinate},
      {ids.of_position, ids.x, ids.position_coordinate},
      {ids.of_orientation, ids.cosine_x, ids.orientation_coordinate},
      {ids.of_acceleration, ids.linear_acceleration, ids.acceleration_twist_coordinate},
  };
  for (const Row& row : rows) {
    for (const Id node : subjects(reader, row.of)) {
      if (!reader.has(node, row.number) || reader.is_a(node, row.type)) continue;
      const auto what = fmt::format("<{}> is stated", reader.text(row.number));
      report_missing_type(reader, node, row.number, what, row.type);
    }
  }
}

void check_inertias_are_typed(GraphReader& reader) {
  const Ids& ids = reader.ids;
  for (const Id node : subjects(reader, ids.of_inertia)) {
    if (!states_inertia(reader, node) || reader.is_a(node, ids.inertia_coordinate) ||
        reader.is_a(node, ids.rotational_inertia_coordinate)) {
      continue;
    }
    report_missing_type(reader, node, ids.of_inertia, "numbers of an inertia are stated",
                        ids.inertia_coordinate);
  }
  for (const Id type : {ids.mass_coordinate, ids.rotational_inertia_coordinate}) {
    for (const Id node : reader.all(type)) {
      if (!states_inertia(reader, node) || reader.is_a(node, ids.inertia_coordinate)) continue;
      reader.warning(
          node, ids.type,
          fmt::format("what a {} states is used in no dynamics", short_name(reader.text(type))),
          "state mass, first moment of mass and moments of inertia of the link with a "
          "RigidBodyInertiaCoordinate");
    }
  }
}

void check_joints_are_typed(GraphReader& reader) {
  for (const Id type : joint_types(reader.ids)) {
    for (const Id node : reader.all(type)) {
      if (reader.is_a(node, reader.ids.joint)) continue;
      report_missing_type(reader, node, reader.ids.type,
                          fmt::format("this is a {}", short_name(reader.text(type))),
                          reader.ids.joint);
    }
  }
}

void check_chains(GraphReader& reader) {
  const Ids& ids = reader.ids;
  for (const Id chain : reader.all(ids.chain)) {
    for (const Id joint : reader.objects(chain, ids.joints)) {
      if (reader.is_a(joint, ids.joint)) continue;
      reader.error(chain, ids.joints, fmt::format("<{}> is no joint", reader.text(joint)),
                   "list joints of these models, or load the model that has it as well");
    }
  }
}

// Where chains list joints, those that they leave out move all the same. Between two links that
// listed joints connect, one has been forgotten; at one of them, it may belong to what was mounted
// there.
void check_joints_are_listed(GraphReader& reader, const Structure& structure) {
  const Ids& ids = reader.ids;
  std::unordered_map<Id, Id> chain_of;  // by joint
  for (const Id chain : reader.all(ids.chain))
    for (const Id joint : reader.objects(chain, ids.joints)) chain_of.emplace(joint, chain);
  if (chain_of.empty()) return;
  std::unordered_map<int, Id> chain_at;  // by link
  const auto ends = [&](const Structure::Joint& joint) {
    return std::array{structure.frames[joint.parent].link, structure.frames[joint.child].link};
  };
  for (const Structure::Joint& joint : structure.joints)
    if (const auto chain = chain_of.find(joint.iri); chain != chain_of.end())
      for (const int link : ends(joint)) chain_at.emplace(link, chain->second);
  for (const Structure::Joint& joint : structure.joints) {
    if (joint.kind == JointKind::kFixed || chain_of.contains(joint.iri)) continue;
    const auto [parent, child] = ends(joint);
    const auto at_parent = chain_at.find(parent), at_child = chain_at.find(child);
    const bool parent_listed = at_parent != chain_at.end(),
               child_listed = at_child != chain_at.end();
    if (!parent_listed && !child_listed) continue;
    const auto name = [&](int link) { return reader.text(structure.links[link].iri); };
    const std::string_view chain =
        reader.text(parent_listed ? at_parent->second : at_child->second);
    if (parent_listed && child_listed) {
      reader.error(joint.iri, ids.between_attachments,
                   fmt::format("the joint moves <{}> and <{}> of <{}>, which does not list it, and "
                               "nor does another chain",
                               name(parent), name(child), chain),
                   "add it to the chain's \"joints\"");
    } else {
      reader.warning(joint.iri, ids.between_attachments,
                     fmt::format("the joint moves <{}> against <{}> of <{}>, though no chain lists "
                                 "it",
                                 name(parent_listed ? child : parent),
                                 name(parent_listed ? parent : child), chain),
                     "add it to the chain's \"joints\", or to those of a chain of its own");
    }
  }
}

}  // namespace

void report_unread(GraphReader& reader, const Structure& structure) {
  check_coordinates(reader);
  check_inertias_are_typed(reader);
  check_joints_are_typed(reader);
  check_chains(reader);
  check_joints_are_listed(reader, structure);
}

}  // namespace sinew::model
