// The parts of reading joints (read_chain.cpp): axes, compound joints (read_compound.cpp), and what
// is said of joints in nodes of its own (read_joint_properties.cpp).
#pragma once

#include "sinew/model/graph_reader.h"
#include "sinew/model/structure.h"

namespace sinew::model {

// The axis of a joint, or of one motion of it, as a unit vector, seen from both attachments alike.
// `facts` holds the attachments.
std::optional<Vector3> read_axis(GraphReader& reader, const Structure& structure, Id joint,
                                 const Structure::Joint& facts);

// All types that say how a joint moves; a joint is of one of them.
std::vector<Id> joint_types(const Ids& ids);

// What a compound joint's type says; nothing for other joints.
std::optional<JointKind> compound_kind(const GraphReader& reader, Id joint);

// Whether a joint of this kind has one axis of its own (a planar joint's is the plane's normal).
bool has_axis(JointKind kind);

// The motions of a compound joint, whose axis has been read. Helical joints get their pitch with
// the other properties. False, and an error, for a sequence that is none.
bool read_motions(GraphReader& reader, const Structure& structure, Structure::Joint& joint);

// Limits, pitch, transmissions, mimicry.
void read_joint_properties(GraphReader& reader, Structure& structure);

}  // namespace sinew::model
