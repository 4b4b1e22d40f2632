// The inside of a world, for the module's own functions.
//
// Locks, in the order in which they are taken: `editing` (one structural edit, ordinary write,
// clone or claim at a time) or `packing` (of links), then `instant` (the state and the graph change
// together, or are taken together), then `publishing` (the published state, a few instructions),
// then the family's.
#pragma once

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/world/plan.h"
#include "sinew/world/world.h"

namespace sinew::world {

// What a world shares with its clones.
struct Family {
  Names names;
  std::shared_ptr<ChangeBoard> changes = std::make_shared<ChangeBoard>();
  std::shared_ptr<ReaderPlaces> readers = std::make_shared<ReaderPlaces>();  // of the past
  std::mutex mutex;
  // For each owner of cells: the epochs that living clones see it at, and how many see each.
  std::map<std::uint64_t, std::map<Epoch, std::size_t>> seen;
  // The oldest epoch of that owner that somebody sees; kNow: nobody.
  Epoch oldest_seen(std::uint64_t owner) {
    const std::lock_guard lock(mutex);
    const auto found = seen.find(owner);
    return found == seen.end() || found->second.empty() ? kNow : found->second.begin()->first;
  }
};

// The worlds that a clone comes from, and the epoch at which it saw each of them last.
struct Ancestor {
  Ancestor(std::shared_ptr<Family> of, std::uint64_t token, Epoch epoch,
           std::shared_ptr<const Ancestor> before);
  ~Ancestor();
  std::shared_ptr<Family> family;
  std::uint64_t owner;
  Epoch as_of;
  std::shared_ptr<const Ancestor> parent;
  std::uint32_t depth = 1;
};
// How many clones may be made of clones, one after the other.
inline constexpr std::uint32_t kMaximumCloneDepth = 64;

struct Symbols;

struct WorldImpl {
  explicit WorldImpl(std::string_view iri);
  WorldImpl(const WorldImpl& original, const State& state, Epoch as_of);
  ~WorldImpl();

  std::string iri;
  std::shared_ptr<Family> family;
  std::shared_ptr<const Ancestor> ancestors;
  std::uint64_t token;                       // owner of the cells that this world may write
  std::atomic<Epoch> epoch = 1;              // clones made so far, and one
  std::atomic<std::uint64_t> structure = 1;  // structural edits so far, and one
  std::mutex editing;
  mutable std::mutex instant;
  mutable std::mutex publishing;
  State state;                        // the published one
  State origin;                       // of a clone: the state it began with
  std::uint64_t origin_owner = 0;     // whose clone it is
  std::vector<WriterState*> writers;  // of the real-time handles
  WriteGuard guard;
  std::shared_ptr<BatchState> batch = std::make_shared<BatchState>(kBatchIdle);  // write_together
  mutable std::mutex packing;
  std::shared_ptr<const Links> links;  // of the structure's version `links_of`
  std::uint64_t links_of = 0;
  std::unique_ptr<Symbols> symbols;          // the graph, once it is needed (symbols.h)
  std::optional<graph::Snapshot> inherited;  // of a clone: what the original's graph held

  State published() const {
    const std::lock_guard lock(publishing);
    return state;
  }
  void publish(State next) {
    const std::lock_guard lock(publishing);
    state = std::move(next);
    structure.fetch_add(1, std::memory_order_release);
  }
  // A change that no plan depends on.
  void publish_quietly(State next) {
    const std::lock_guard lock(publishing);
    state = std::move(next);
  }
  // Where this world sees the cells of an owner.
  Epoch as_of(std::uint64_t owner) const {
    if (owner == token) return kNow;
    for (const Ancestor* at = ancestors.get(); at; at = at->parent.get()) {
      if (at->owner == owner) return at->as_of;
    }
    return kNow;
  }
  std::shared_ptr<const Plan> plan(const PoseQuery& query, bool motion) const;
};

// One write to a cell by whoever holds `editing`: the spare is made when it is needed.
struct SpareOnDemand {
  SpareOnDemand(Cell& cell, Family& family, Epoch epoch)
      : ring(cell.needs_spare(epoch) ? cell.spare(family.oldest_seen(cell.owner())) : nullptr) {}
  Ring* ring;
};

// The cell of a measurement for writing in this world: its own, or a copy of the ancestor's that is
// put in its place (which is no structural change for others, but prepared queries must notice).
Cell& own_cell(WorldImpl& world, MeasurementId measurement);

// Writes a value that `acceptable` has passed; `editing` is held.
Status write_checked(WorldImpl& world, MeasurementId measurement, Stamp stamp,
                     const std::vector<double>& values, std::string_view provenance);

// The next version of a measurement's history; `editing` is held.
void keep(WorldImpl& world, MeasurementId measurement, History history);
// What a handle has written since the last time, into the histories; `editing` is held. Returns how
// many entries.
std::size_t collect(WorldImpl& world, WriterState& writer);
// Of a clone that nobody has yet: what the handle's log had not given to the histories when it was
// made is taken from the rings.
void complete_histories(WorldImpl& clone, const WriterState& writer, Epoch as_of);

// Whether numbers can be a value of this quantity; makes quaternions exactly unit.
bool acceptable(Quantity quantity, std::span<double> values);

// Throws Error naming the element unless it is alive.
const FrameRecord& alive(const WorldImpl& world, const State& state, FrameId id);
const RelationRecord& alive(const WorldImpl& world, const State& state, RelationId id);
const MeasurementRecord& alive(const WorldImpl& world, const State& state, MeasurementId id);
const ObjectRecord& alive(const WorldImpl& world, const State& state, ObjectId id);

}  // namespace sinew::world
