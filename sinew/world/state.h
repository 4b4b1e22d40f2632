// What a world consists of, as one persistent value: frames, objects, relations between frames, and
// measurements of the relations. The values themselves are in cells (cell.h); a state only points
// at them. Copying a state costs five reference counts, whatever its size: that is what a clone
// does.
//
// Indices are never used again; what was removed stays as a dead record.
#pragma once

#include <compare>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "sinew/world/block_set.h"
#include "sinew/world/cell.h"
#include "sinew/world/history.h"
#include "sinew/world/ids.h"
#include "sinew/world/life_cycle.h"
#include "sinew/world/names.h"
#include "sinew/world/persistent_vector.h"
#include "sinew/world/pose.h"
#include "sinew/world/published_history.h"

namespace sinew::world {

// What a measurement's numbers are. A twist or acceleration of B with respect to A is seen from B.
enum class Quantity : std::uint8_t {
  kPose,               // 7: quaternion x y z w, position x y z [m]
  kTwist,              // 6: angular, linear [rad/s, m/s]
  kAcceleration,       // 6: angular, linear, classical [rad/s^2, m/s^2]
  kJointPosition,      // 1 [rad or m]
  kJointVelocity,      // 1
  kJointAcceleration,  // 1
  kOther,              // as many as declared; interpolated number by number
};

enum class RelationKind : std::uint8_t {
  kFree,       // measured as a pose
  kRevolute,   // measured as a joint's position, about z of the joint's frame
  kPrismatic,  // the same along z
  kProperty,   // of one entity: colour, mass, …; `with_respect_to` is none
};

enum class Interpolation : std::uint8_t {
  kLinear,  // of poses: straight line and SLERP
  kScrew,   // of poses: the geodesic of SE(3); of numbers the same as kLinear
  kHold,    // the last entry until the next one comes
};

// What is known of a measurement besides its numbers. Immutable.
struct MeasurementModel {
  LifeCycle life_cycle = TimeDependent{};
  Interpolation interpolation = Interpolation::kLinear;
  std::string provenance = {};   // IRI of who provides it
  std::string coord_frame = {};  // IRI of the frame from which it was measured; may be empty
  std::vector<std::string> used_by = {};  // IRIs of who has read access
  double standard_deviation = std::numeric_limits<double>::quiet_NaN();  // NaN: not stated
  Duration period = kForever;  // between updates, as declared
};

struct FrameRecord {
  Name name;
  bool alive = false;
  Index first_relation = kNone;  // the list of those that touch it
};

struct RelationRecord {
  Name name;
  Index of = kNone, with_respect_to = kNone;                  // frames: B and A of X_AB
  Index next_at_of = kNone, next_at_with_respect_to = kNone;  // the frames' lists
  Index first_measurement = kNone;
  RelationKind kind = RelationKind::kFree;
  bool alive = false;
  bool suspended =
      false;  // kept, written, but no way leads over it while `of` is attached elsewhere
  bool attachment = false;  // made by `attach`
  Pose placement;  // of a joint: pose of the joint's frame in A; the joint moves B from there
};

struct MeasurementRecord {
  Name name;
  Index relation = kNone;
  Index next = kNone;  // of the same relation
  Quantity quantity = Quantity::kPose;
  bool alive = false;
  std::shared_ptr<Cell> cell;
  std::shared_ptr<const MeasurementModel> model;
  std::shared_ptr<const BlockSet> blocks;  // none: null
  std::shared_ptr<const std::vector<std::shared_ptr<Cell>>> block_cells;
  std::shared_ptr<const History> history;  // null: only the ring is kept
  // The same for real-time readers; as `history` where the cell is this world's own.
  std::shared_ptr<PublishedHistory> published;
};

struct ObjectRecord {
  Name name;
  Name model;  // instance-of; may be none
  Index frame = kNone;
  bool alive = false;
};

enum class ElementKind : std::uint8_t { kNothing, kFrame, kObject, kRelation, kMeasurement };
struct Element {
  ElementKind kind = ElementKind::kNothing;
  Index index = kNone;
  friend auto operator<=>(const Element&, const Element&) = default;
};

struct State {
  PersistentVector<FrameRecord> frames;
  PersistentVector<RelationRecord> relations;
  PersistentVector<MeasurementRecord> measurements;
  PersistentVector<ObjectRecord> objects;
  PersistentVector<Element> by_name;  // at Name::value

  Element find(Name name) const {
    const Element* const element = by_name.find(name.value);
    return element ? *element : Element{};
  }
};

std::uint32_t size_of(Quantity quantity);  // 0: as declared
std::string_view to_string(Quantity quantity);
std::string_view to_string(ElementKind kind);

}  // namespace sinew::world
