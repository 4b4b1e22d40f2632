// What synthesis needs to know of a normalised tree as a whole: where it starts, its joints in
// order, its tips. Steps find everything else by their own queries.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/places.h"
#include "sinew/graph/store.h"

namespace sinew::synthesis {

using graph::Id;

struct RobotJoint {
  Id joint;
  std::string kind;           // "revolute", "prismatic", "floating"
  Id joint_frame;             // fixed to the predecessor
  Id frame;                   // the successor's
  Id predecessor, successor;  // bodies
  Id parent_frame;            // the predecessor's frame
  std::string label = {};     // names its data blocks; empty: its own name does
  int compound = -1;          // index into Robot::compounds, of which it is a part
  // Its position is `ratio` times that of another joint plus `offset`; -1: it is free.
  int follows = -1;
  double ratio = 1, offset = 0;
  double rotor_inertia = 0;  // of a rotor behind a gear, as the joint feels it
};

// A joint of the model that the tree has several joints for.
struct RobotCompound {
  Id joint;
  std::string kind;                // "spherical", "planar", ...
  std::vector<std::size_t> parts;  // indices into Robot::joints

  // Whether its velocities are about (along) axes of the successor: spherical, floating.
  bool is_free() const { return kind == "spherical" || kind == "floating"; }
};

struct Robot {
  Id root_frame, root_body;        // of a floating robot: the world's
  Id base_acceleration;            // coordinate node; null when the model states no gravity
  std::vector<RobotJoint> joints;  // by tree:index
  std::vector<RobotCompound> compounds = {};

  // Whether some joint follows another, so that there are fewer coordinates than joints.
  bool coupled() const;
  // False where the joint's successor only stands between the parts of a compound.
  bool leads_to_link(const RobotJoint& joint) const;
};

// Reads the normalised tree; Error when there is none, or more than one root.
Robot read_robot(graph::Store& store, const graph::View& view);
// Its root only.
Robot read_base(graph::Store& store, const graph::View& view);

// The joints from the root to a frame, as indices into `joints`, the first from the root first.
std::vector<std::size_t> path_to(const Robot& robot, const graph::View& view, Id frame);

// The frame of each leaf: of each link to which no other link is attached.
std::vector<Id> leaf_frames(graph::Store& store, const graph::View& view, const Robot& robot);

// A frame by its IRI, by the last segment of it, or by those of a link (its root frame). Error that
// lists what is near or ambiguous.
Id find_frame(graph::Store& store, const graph::View& view, std::string_view name);

// The body frame to which a frame is fixed; itself when it is one.
Id body_frame(const graph::View& view, Id frame);

}  // namespace sinew::synthesis
