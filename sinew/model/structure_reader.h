// The parts of reading a model's structure, one for each concern; see structure.h. Each needs what
// those above it have read.
#pragma once

#include "sinew/model/graph_reader.h"
#include "sinew/model/structure.h"

namespace sinew::model {

void read_links_and_frames(GraphReader& reader, Structure& structure);
void read_poses(GraphReader& reader, Structure& structure);
void read_joints(GraphReader& reader, Structure& structure);
void read_inertias(GraphReader& reader, Structure& structure);
void read_base_accelerations(GraphReader& reader, Structure& structure);

// What the others pass over, since it does not say what it is: numbers of poses and inertias, and
// joints, without the type by which they are found; and joints of a chain that are none.
void report_unread(GraphReader& reader, const Structure& structure);

// Whether the node has any number of a rigid-body inertia.
bool states_inertia(const GraphReader& reader, Id node);

// The index of the frame that `property` of `node` points to; kNone, and an error, when it is no
// frame.
int frame_of(GraphReader& reader, Structure& structure, Id node, Id property,
             std::string_view what);

}  // namespace sinew::model
