// What is asked of a robot, what is given, and how to go about it. A query is a model (JSON-LD,
// type sq:Query); this is the same as plain values. The named queries of solvers/ are such models
// with blanks: base, tips and gravity.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/task/task.h"

namespace sinew::synthesis {

inline constexpr std::string_view kQueryNamespace = "https://w3id.org/sinew/query#";

// Elements are named by IRI, or by its last segment where that is unambiguous. These stand for
// several.
inline constexpr std::string_view kEveryJoint = "every-joint";
inline constexpr std::string_view kEveryTip = "every-tip";  // the query's tips, or every leaf

// These stand for one frame, in `seen_by`.
inline constexpr std::string_view kItself = "itself";  // the frame that is asked for, or given
inline constexpr std::string_view kBase = "base";

// Where a part of a query was written, for errors. It is no part of what is said, so any two are
// equal.
struct Origin {
  std::string iri;  // of its node; empty where it has no name
  Place place;
  friend bool operator==(const Origin&, const Origin&) { return true; }
};

struct Asked {
  std::string quantity;  // a row of asked.cpp: "pose", "joint-force", "mass-matrix", ...
  std::string of;        // frame, joint or link; kEveryTip, kEveryJoint; empty for the whole robot
  // Of motions of frames: the frame whose axes give the directions; kBase, kItself. Empty: the
  // frame that the motion is with respect to.
  std::string seen_by;
  std::string with_respect_to = {};  // of poses and motions of frames; empty: the base
  Origin origin = {};

  bool operator==(const Asked&) const = default;
};

struct Given {
  std::string quantity;  // a row of asked.cpp: "joint-position", "gravity", "external-wrench", ...
  std::string of;        // as above
  // Of wrenches: kItself (also when it is empty) or kBase. They are always about the origin of the
  // frame on which they act.
  std::string seen_by = {};
  bool varies = false;   // of gravity: an input of each call instead of a constant
  std::string iri = {};  // its own node, where it has one

  // Of an acceleration constraint: the directions in which the frame's acceleration with respect to
  // the base is imposed, each by a unit constraint force. Axes are "linear-x" ... "angular-z"; any
  // other unit force is six numbers, moment first; and so many more come as inputs.
  std::vector<std::string> directions = {};
  std::vector<std::array<double, 6>> unit_forces = {};
  unsigned direction_inputs = 0;  // seen by the base's axes (also when it is empty) or by its own
  Origin origin = {};

  bool operator==(const Given&) const = default;
};

// A quantity that is had at a lower rate than the rest. What is given then changes slowly, and what
// depends on that alone is computed by the program's update, which runs after each change: no
// result changes. What is asked, or computed on the way, keeps its value from one update to the
// next: an approximation that the query asks for (program/partial.h).
struct Held {
  std::string quantity;  // given, asked, or of anything computed on the way
  std::string of = {};   // one element of it; empty, kEveryJoint, kEveryTip: all
  Origin origin = {};

  bool operator==(const Held&) const = default;
};

// How the effects of several drivers become one.
enum class Forces {
  kTogether,  // added up as early as can be, which is cheapest
  kApart,     // each external wrench's share of each joint's force stays to be seen
};
// What an acceleration twist is the derivative of, for the frame that it is of.
enum class Frames {
  kMoving,      // of the velocity of its origin, which moves with the body: classical
  kStationary,  // of the velocity of the body at the point in space where its origin is: spatial
};

// What happens where acceleration constraints depend on each other, or the robot cannot move their
// way (math/constraint_solve.h).
enum class Singular : std::uint8_t { kUnstated, kInOrder, kDamped, kTruncated };

// Whether the effects of drivers (gravity, velocity, wrenches, joint forces, constraints) are added
// up early, or each is carried on by itself to the last sweep, which may then weigh them.
enum class DriverList : std::uint8_t { kTogether, kApart, kWeighed };

struct DriverPolicy {
  Singular singular = Singular::kUnstated;
  double singular_number = 0;  // tolerance, or damping; both of the scaled matrix, without unit
  DriverList list = DriverList::kTogether;
  // The driver that is scaled down until no actuator saturates: a constraint or a joint force, by
  // IRI or its last segment, or "joint-force" for all of those; empty: none is.
  std::string limited;
  Origin singular_origin = {}, limited_origin = {};

  bool operator==(const DriverPolicy&) const = default;
};

struct Query {
  std::string name;  // of the program that answers it
  // Of its model, for errors; empty where it has none.
  std::string iri = {};
  Place place = {};
  std::vector<Asked> asked;
  std::vector<Given> given;

  std::string base;               // a link or frame; empty: the tree's root
  std::vector<std::string> tips;  // empty: every leaf
  Origin base_origin = {}, tips_origin = {};
  // The gravity vector [m/s^2] seen from the base; overrides the model's.
  std::optional<std::array<double, 3>> gravity;
  bool floating = false;  // the base moves freely: its pose, twist and acceleration come first
  // Inertias may be regrouped for speed, where nothing that is asked could tell (regroup.h).
  bool regroup = true;
  Forces forces = Forces::kTogether;
  Frames frames = Frames::kMoving;
  // Whose controllers work with the solver (control.h); null: none.
  std::shared_ptr<const task::Task> task = nullptr;
  DriverPolicy drivers;
  std::vector<Held> held = {};
  std::string sweeps;  // name of a hand-written sweep configuration; empty: planned
};

// The same facts in one line, always in the same words: what the algorithm's IRI is derived from.
std::string canonical_text(const Query& query);

}  // namespace sinew::synthesis
