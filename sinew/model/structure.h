// A model's graph read into plain data, still as the model says it: links, frames, constant poses,
// joints, inertias. Numbers are in SI units; nothing is composed or chosen yet. What is not as the
// metamodels ask is reported with its place.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/model/ids.h"
#include "sinew/model/tree.h"

namespace sinew::model {

constexpr int kNone = -1;

struct Structure {
  struct Link {
    Id iri;
    std::vector<int> frames;  // in the order of `simplices`
  };

  struct Frame {
    Id iri;
    Id origin;         // a point; may be unknown
    int link = kNone;  // kNone when it is no simplex of a link
  };

  struct Point {
    Id iri;
    int link = kNone;
  };

  // A constant pose of one frame in another.
  struct ConstantPose {
    Id coordinate;
    int of = kNone, with_respect_to = kNone;  // frames
    Pose pose;
  };

  // The position of a point with respect to another one, seen from a frame.
  struct Position {
    Id coordinate;
    Id of, with_respect_to;  // points
    int seen_by = kNone;     // frame
    Vector3 position;
  };

  // One turn or slide of a joint that is a sequence of them.
  struct Motion {
    Id iri;  // where the model has a node for it
    JointKind kind = JointKind::kRevolute;
    Vector3 axis;          // unit vector, in both attachments at position zero
    bool follows = false;  // the motion before it, `ratio` times
    double ratio = 1;      // m/rad
    JointLimits limits;
  };

  // That a joint's position is `multiplier` times that of another, plus `offset`.
  struct Mimicry {
    Id node;
    Id leader;
    double multiplier = 1;
    double offset = 0;  // rad or m
  };

  struct Joint {
    Id iri;
    JointKind kind = JointKind::kRevolute;
    int parent = kNone, child = kNone;  // frames
    bool directed = false;              // whether the model says which is the parent
    Vector3 axis;       // unit vector, the way in which the position grows; the same in both frames
    double offset = 0;  // of the child's origin along the axis at joint position zero
    JointLimits limits;
    std::vector<Motion> motions;  // of a compound joint; empty for others
    std::optional<Mimicry> mimicry;
    double rotor_inertia = 0;  // reflected to the joint [kg m^2 or kg]
  };

  struct Inertia {
    Id coordinate;
    Id link;                 // as the model says; a link or nothing
    Id about;                // point
    int seen_by = kNone;     // frame
    RigidBodyInertia value;  // about that point, with axes of that frame
  };

  // The acceleration of a link, which stands for gravity.
  struct BaseAcceleration {
    Id coordinate;
    Id of, with_respect_to;  // links
    Id reference_point;
    int seen_by = kNone;  // frame
    AccelerationTwist value;
  };

  std::vector<Link> links;
  std::vector<Frame> frames;
  std::vector<ConstantPose> poses;
  std::vector<Position> positions;
  std::vector<Joint> joints;
  std::vector<Inertia> inertias;
  std::vector<BaseAcceleration> base_accelerations;
  std::vector<std::string> notes;

  std::unordered_map<Id, int> link_by_iri, frame_by_iri;
  std::unordered_map<Id, int> link_of_point;           // points that are simplices
  std::unordered_map<Id, std::vector<int>> frames_at;  // frames by their origin

  int find_link(Id iri) const;
  int find_frame(Id iri) const;
};

// Everything that a model says. Errors go to the report; what they concern is left out.
Structure read_structure(graph::Store& store, const graph::Places& places, Report& report);

}  // namespace sinew::model
