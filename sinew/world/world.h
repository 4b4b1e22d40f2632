// The world model, in process: frames, objects attached to them, relations between frames, and
// measurements of those relations, each with its provenance, life-cycle and history.
//
//   World world;
//   const FrameId table = world.add_frame("http://cell/table");
//   const FrameId part = world.add_frame("http://cell/part");
//   const RelationId relation = world.add_relation({.name = "http://cell/pose-part-table",
//                                                   .of = part, .with_respect_to = table});
//   const MeasurementId seen = world.add_measurement({.name = "http://cell/seen", .relation =
//   relation,
//                                                     .model = {.provenance =
//                                                     "http://cell/camera"}});
//   world.write(seen, stamp, X_table_part, {.provenance = "http://cell/camera"});
//   PreparedPose query = world.prepare_pose({.of = part, .with_respect_to = table});
//   PoseAnswer answer = query.latest(now);
//
// Relations may form loops, a relation may have several measurements, and a frame several parents:
// a query chooses by its policies (prepared.h). A relation is symbolic, and every element is also
// described in a graph (graph()); the numbers are in memory only.
//
// A World is its owner's, the process that runs it: nothing here asks who reads. Components get
// what is judged: a Participant (participant.h), or a Reader (reader.h).
//
// Threads: structural edits, `write` and `clone` take turns; everything else may be called from any
// thread at any time. Readers never hold up a writer. Real-time threads use handles (handles.h,
// prepared.h), which neither allocate nor lock.
//
// Errors at design time are thrown as sinew::Error with the element's IRI; those of reading and
// writing values are a Status.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/world/answer.h"
#include "sinew/world/handles.h"
#include "sinew/world/ids.h"
#include "sinew/world/prepared.h"
#include "sinew/world/state.h"

namespace sinew::graph {
class Store;
class Transaction;
}  // namespace sinew::graph

namespace sinew::world {

class Edit;
class Links;
struct Situation;

struct RelationSpec {
  std::string_view name;  // IRI
  FrameId of, with_respect_to;
  RelationKind kind = RelationKind::kFree;
  Pose placement = {};  // of a joint; see RelationRecord
};

inline constexpr std::uint32_t kUsualCapacity = 64;

struct MeasurementSpec {
  std::string_view name;  // IRI
  RelationId relation;
  Quantity quantity = Quantity::kPose;
  MeasurementModel model = {};
  std::uint32_t capacity = kUsualCapacity;  // entries kept; rounded up to a power of two
  std::uint32_t values = 0;                 // of Quantity::kOther
  bool keep_all = false;                    // every entry, for users (history.h)
  BlocksSpec blocks = {};                   // the same value in other prototypes (block_set.h)
};

// Who writes. Every write carries it; a hook (set_write_guard) may refuse by it.
struct WriteContext {
  std::string_view provenance;
};

// Told of every write outside real-time handles, and of every claim of one, before it happens;
// refuses by returning a reason. For access rights and audits.
using WriteGuard = std::function<std::optional<std::string>(
    MeasurementId measurement, std::string_view name, const MeasurementModel& model,
    std::string_view provenance)>;

struct WorldImpl;

class World {
 public:
  // `iri` names the world and the graph that describes it.
  explicit World(std::string_view iri = "https://w3id.org/sinew/world/main");
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  // ---- structure (edit.h does several in one transaction) ----
  Edit edit();
  FrameId add_frame(std::string_view iri);
  ObjectId add_object(std::string_view iri, FrameId frame, std::string_view model = {});
  RelationId add_relation(const RelationSpec& spec);
  MeasurementId add_measurement(const MeasurementSpec& spec);
  // A relation that never changes, with its one static measurement.
  MeasurementId add_static(std::string_view relation_iri, FrameId of, FrameId with_respect_to,
                           const Pose& pose, std::string_view provenance);
  // With all that touches it: a frame's relations and their measurements.
  void remove(FrameId frame);
  void remove(RelationId relation);
  void remove(MeasurementId measurement);
  void remove(ObjectId object);
  // The frame's pose with respect to the parent, as it is now, becomes constant; its other
  // relations as `of` are suspended: kept and still written, but no way leads over them. One
  // transaction.
  RelationId attach(FrameId frame, FrameId parent, Stamp now, std::string_view provenance);
  // Ends an attachment; the frame stays where it is, now with respect to `parent`: a suspended
  // relation between the two takes over (and gets the pose as an entry), otherwise a new one.
  RelationId detach(FrameId frame, FrameId parent, Stamp now, std::string_view provenance);

  FrameId find_frame(std::string_view iri) const;  // index kNone where there is none
  RelationId find_relation(std::string_view iri) const;
  MeasurementId find_measurement(std::string_view iri) const;
  ObjectId find_object(std::string_view iri) const;
  const std::string& name(FrameId id) const;
  const std::string& name(RelationId id) const;
  const std::string& name(MeasurementId id) const;
  const std::string& name(ObjectId id) const;
  FrameId frame_of(ObjectId object) const;
  State state() const;  // a version of the whole structure, for whoever wants to walk it; O(1)
  // Which frames are linked by which relations, packed (links.h): made when it is first asked for
  // after a structural edit, the same one as long as there is none. For walks all over the
  // structure. Any thread; takes a lock.
  std::shared_ptr<const Links> links() const;
  std::uint64_t structure_version() const;  // counts structural edits

  // ---- values ----
  // Appends an entry; one with an earlier or the same stamp corrects the past. Checks that the
  // numbers are finite and the quaternion of unit length, the guard, and that nobody holds a
  // real-time handle on the measurement (which would be an Error).
  Status write(MeasurementId measurement, Stamp stamp, const Pose& pose, const WriteContext& who);
  Status write(MeasurementId measurement, Stamp stamp, std::span<const double> values,
               const WriteContext& who);
  // Several measurements as one: readers see all or none. All stamps must be later than the last.
  struct Value {
    MeasurementId measurement;
    std::span<const double> values;
  };
  Status write_together(Stamp stamp, std::span<const Value> values, const WriteContext& who);
  // Handles that it refuses write no more (Status::kForbidden), until another one allows them.
  void set_write_guard(WriteGuard guard);
  // Data blocks, by their place in the measurement's block set. Writing one writes them all;
  // reading several gives them as they were at one instant. Sizes in bytes must be the prototypes'.
  std::size_t find_block(MeasurementId measurement, std::string_view iri) const;
  Status write_block(MeasurementId measurement, std::size_t block, Stamp stamp, const void* value,
                     std::size_t size, const WriteContext& who);
  struct BlockBuffer {
    std::size_t block;
    void* value;
    std::size_t size;
  };
  Status read_blocks(MeasurementId measurement, std::span<const BlockBuffer> buffers,
                     Stamp* stamp = nullptr) const;
  // What the blocks are at another time: made from the measurement's value then, as `at` has it,
  // with all its corrections.
  Status read_blocks_at(MeasurementId measurement, Stamp time,
                        std::span<const BlockBuffer> buffers) const;
  // The numbers at one time, as queries see them; Status::kOk or why not.
  struct Sample {
    Status status = Status::kNoData;
    Stamp stamp;
    std::vector<double> values;
    Freshness freshness;
    Bounds bounds;
  };
  Sample latest(MeasurementId measurement, Stamp now) const;
  Sample at(MeasurementId measurement, Stamp time) const;
  // All entries of a measurement that keeps them, as they are now; Error for others.
  History history(MeasurementId measurement) const;
  // Takes what real-time writers have written into the histories (collector.h does it every so
  // often); returns how many entries.
  std::size_t collect();
  // That user needs none of the first `count` entries of that history any more. Entries that all
  // declared users are done with are let go.
  void done(MeasurementId measurement, std::string_view user, const History& history,
            std::size_t count);
  // What is known of a measurement; its prediction model among it, for who wants to predict
  // himself.
  std::shared_ptr<const MeasurementModel> model(MeasurementId measurement) const;

  // ---- handles ----
  // A measurement for one real-time writer, until the handle is destroyed.
  Writer claim(MeasurementId measurement, const WriteContext& who);
  BatchWriter claim(std::span<const MeasurementId> measurements, const WriteContext& who);

  // ---- queries (prepared.h) ----
  PreparedPose prepare_pose(const PoseQuery& query) const;
  PreparedMotion prepare_motion(const PoseQuery& query) const;
  PoseAnswer pose(FrameId of, FrameId with_respect_to, Stamp now) const;
  // With Policy::kWait: asks until the answer is fresh or `time_out` is over, by the given clock.
  PoseAnswer wait_for_pose(const PoseQuery& query, Duration time_out,
                           const std::function<Stamp()>& clock) const;

  // ---- clones (clone.h: differences and merging) ----
  // The same world with a life of its own from now on, in O(1).
  World clone() const;

  // ---- graph ----
  // The world's description (docs/world.md) in a named graph. A clone's is made when it is first
  // asked for. What else the store holds is the user's.
  graph::Store& graph();
  // Facts and structure as they are at one instant (situation.h).
  Situation situation();

  WorldImpl& impl() const { return *impl_; }  // for the module's own functions

 private:
  friend class Reader;
  explicit World(std::shared_ptr<WorldImpl> impl);
  std::shared_ptr<WorldImpl> impl_;
};

}  // namespace sinew::world
