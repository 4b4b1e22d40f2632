#include "sinew/world/world.h"

#include <cmath>
#include <thread>

#include "sinew/world/edit.h"
#include "sinew/world/impl.h"
#include "sinew/world/links.h"
#include "sinew/world/reading.h"
#include "sinew/world/refuse.h"
#include "sinew/world/symbols.h"

namespace sinew::world {
namespace {

template <typename Record, typename Id>
const Record& alive_in(const PersistentVector<Record>& records, Id id, const char* kind) {
  const Record* const record = records.find(id.index);
  if (!record || !record->alive) {
    refuse({}, "there is no " + std::string(kind) + " number " + std::to_string(id.index),
           "an element of this world that was not removed");
  }
  return *record;
}

// How often Policy::kWait looks again.
constexpr std::chrono::microseconds kWaitPeriod{200};

}  // namespace

Ancestor::Ancestor(std::shared_ptr<Family> of, std::uint64_t of_owner, Epoch epoch,
                   std::shared_ptr<const Ancestor> before)
    : family(std::move(of)), owner(of_owner), as_of(epoch), parent(std::move(before)) {
  if (parent) depth = parent->depth + 1;
  const std::lock_guard lock(family->mutex);
  ++family->seen[owner][as_of];
}

Ancestor::~Ancestor() {
  const std::lock_guard lock(family->mutex);
  auto& epochs = family->seen[owner];
  if (--epochs[as_of] == 0) epochs.erase(as_of);
  if (epochs.empty()) family->seen.erase(owner);
}

WorldImpl::WorldImpl(std::string_view world_iri)
    : iri(world_iri), family(std::make_shared<Family>()), token(fresh_token()) {}

WorldImpl::WorldImpl(const WorldImpl& original, const State& of, Epoch as_of)
    : iri(original.iri),
      family(original.family),
      ancestors(std::make_shared<const Ancestor>(original.family, original.token, as_of,
                                                 original.ancestors)),
      token(fresh_token()),
      state(of),
      origin(of),
      origin_owner(original.token),
      guard(original.guard) {}

WorldImpl::~WorldImpl() = default;

std::shared_ptr<const Plan> WorldImpl::plan(const PoseQuery& query, bool motion) const {
  const std::uint64_t version = structure.load(std::memory_order_acquire);
  return make_plan(
      published(), family->names, [this](std::uint64_t owner) { return as_of(owner); }, query,
      motion, version);
}

const FrameRecord& alive(const WorldImpl&, const State& state, FrameId id) {
  return alive_in(state.frames, id, "frame");
}
const RelationRecord& alive(const WorldImpl&, const State& state, RelationId id) {
  return alive_in(state.relations, id, "relation");
}
const MeasurementRecord& alive(const WorldImpl&, const State& state, MeasurementId id) {
  return alive_in(state.measurements, id, "measurement");
}
const ObjectRecord& alive(const WorldImpl&, const State& state, ObjectId id) {
  return alive_in(state.objects, id, "object");
}

bool acceptable(Quantity quantity, std::span<double> values) {
  if (quantity == Quantity::kPose) {
    if (values.size() != 7) return false;
    Pose X = load_pose(values.data());
    if (!normalise(X)) return false;
    store_pose(X, values.data());
    return true;
  }
  for (const double value : values) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

Cell& own_cell(WorldImpl& world, MeasurementId measurement) {
  const MeasurementRecord& record = alive(world, world.state, measurement);
  if (record.cell->owner() == world.token) return *record.cell;
  const auto cell = std::make_shared<Cell>(*record.cell, world.as_of(record.cell->owner()),
                                           world.token, world.epoch.load(), world.family->changes);
  State next = world.published();
  MeasurementRecord& mine = next.measurements.edit(measurement.index, fresh_token());
  mine.cell = cell;
  if (mine.block_cells) {
    auto cells = std::make_shared<std::vector<std::shared_ptr<Cell>>>();
    for (const auto& block : *mine.block_cells) {
      cells->push_back(std::make_shared<Cell>(*block, world.as_of(block->owner()), world.token,
                                              world.epoch.load()));
    }
    mine.block_cells = cells;
  }
  if (mine.history) {
    mine.published = std::make_shared<PublishedHistory>(world.family->readers, mine.history);
  }
  world.publish(std::move(next));
  return *cell;
}

// ---- structure ----

World::World(std::string_view iri) : impl_(std::make_shared<WorldImpl>(iri)) {}
World::World(std::shared_ptr<WorldImpl> impl) : impl_(std::move(impl)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

Edit World::edit() { return Edit(impl_); }

template <typename Change>
auto commit(Edit edit, Change&& change) {
  if constexpr (std::is_void_v<decltype(change(edit))>) {
    change(edit);
    edit.commit();
  } else {
    const auto result = change(edit);
    edit.commit();
    return result;
  }
}

FrameId World::add_frame(std::string_view iri) {
  return commit(edit(), [&](Edit& e) { return e.add_frame(iri); });
}
ObjectId World::add_object(std::string_view iri, FrameId frame, std::string_view model) {
  return commit(edit(), [&](Edit& e) { return e.add_object(iri, frame, model); });
}
RelationId World::add_relation(const RelationSpec& spec) {
  return commit(edit(), [&](Edit& e) { return e.add_relation(spec); });
}
MeasurementId World::add_measurement(const MeasurementSpec& spec) {
  return commit(edit(), [&](Edit& e) { return e.add_measurement(spec); });
}
MeasurementId World::add_static(std::string_view relation_iri, FrameId of, FrameId with_respect_to,
                                const Pose& pose, std::string_view provenance) {
  return commit(edit(), [&](Edit& e) {
    return e.add_static(relation_iri, of, with_respect_to, pose, provenance);
  });
}
void World::remove(FrameId frame) {
  commit(edit(), [&](Edit& e) { e.remove(frame); });
}
void World::remove(RelationId relation) {
  commit(edit(), [&](Edit& e) { e.remove(relation); });
}
void World::remove(MeasurementId measurement) {
  commit(edit(), [&](Edit& e) { e.remove(measurement); });
}
void World::remove(ObjectId object) {
  commit(edit(), [&](Edit& e) { e.remove(object); });
}
RelationId World::attach(FrameId frame, FrameId parent, Stamp now, std::string_view provenance) {
  return commit(edit(), [&](Edit& e) { return e.attach(frame, parent, now, provenance); });
}
RelationId World::detach(FrameId frame, FrameId parent, Stamp now, std::string_view provenance) {
  return commit(edit(), [&](Edit& e) { return e.detach(frame, parent, now, provenance); });
}

namespace {

Index find(const WorldImpl& world, std::string_view iri, ElementKind kind) {
  const Element element = world.published().find(world.family->names.find(iri));
  return element.kind == kind ? element.index : kNone;
}

}  // namespace

FrameId World::find_frame(std::string_view iri) const {
  return {find(*impl_, iri, ElementKind::kFrame)};
}
RelationId World::find_relation(std::string_view iri) const {
  return {find(*impl_, iri, ElementKind::kRelation)};
}
MeasurementId World::find_measurement(std::string_view iri) const {
  return {find(*impl_, iri, ElementKind::kMeasurement)};
}
ObjectId World::find_object(std::string_view iri) const {
  return {find(*impl_, iri, ElementKind::kObject)};
}
const std::string& World::name(FrameId id) const {
  return impl_->family->names.text(alive(*impl_, impl_->published(), id).name);
}
const std::string& World::name(RelationId id) const {
  return impl_->family->names.text(alive(*impl_, impl_->published(), id).name);
}
const std::string& World::name(MeasurementId id) const {
  return impl_->family->names.text(alive(*impl_, impl_->published(), id).name);
}
const std::string& World::name(ObjectId id) const {
  return impl_->family->names.text(alive(*impl_, impl_->published(), id).name);
}
FrameId World::frame_of(ObjectId object) const {
  return {alive(*impl_, impl_->published(), object).frame};
}
State World::state() const { return impl_->published(); }
std::shared_ptr<const Links> World::links() const {
  WorldImpl& impl = *impl_;
  const std::lock_guard lock(impl.packing);
  // Asked first: a state that is newer than it is packed again next time.
  const std::uint64_t version = structure_version();
  if (!impl.links || impl.links_of != version) {
    impl.links = std::make_shared<const Links>(impl.published());
    impl.links_of = version;
  }
  return impl.links;
}
std::uint64_t World::structure_version() const {
  return impl_->structure.load(std::memory_order_acquire);
}
std::shared_ptr<const MeasurementModel> World::model(MeasurementId measurement) const {
  return alive(*impl_, impl_->published(), measurement).model;
}

// ---- handles ----

namespace {

std::unique_ptr<WriterState> claim_cells(WorldImpl& world,
                                         std::span<const MeasurementId> measurements,
                                         const WriteContext& who) {
  auto state = std::make_unique<WriterState>();
  state->who = who.provenance;
  for (const MeasurementId measurement : measurements) {
    const MeasurementRecord record = alive(world, world.published(), measurement);
    const std::string& iri = world.family->names.text(record.name);
    if (world.guard) {
      if (const auto reason = world.guard(measurement, iri, *record.model, who.provenance)) {
        refuse(iri, *reason, "who is declared as its provenance writes it");
      }
    }
    if (std::holds_alternative<Static>(record.model->life_cycle)) {
      refuse(iri, "a writer for a static measurement", "another life-cycle, or no writer");
    }
    Cell& cell = own_cell(world, measurement);
    if (!cell.claimed_by.empty()) {
      refuse(iri, "a real-time writer is at work: " + cell.claimed_by,
             "let that one go first; a measurement has one real-time writer");
    }
    for (const auto& other : state->targets) {
      if (other->cell.get() == &cell) refuse(iri, "claimed twice for one batch", "once");
    }
    const MeasurementRecord& own = world.state.measurements[measurement.index];
    auto target = std::make_unique<WriterState::Target>();
    target->cell = own.cell;
    target->is_pose = record.quantity == Quantity::kPose;
    target->measurement = measurement;
    if (own.history) {
      const std::size_t held = std::min(kMaximumHistory, own.history->size());
      target->log = std::make_unique<WriteLog>(own.cell->values(), own.cell->capacity() - 1,
                                               kMaximumHistory - held);
    }
    target->blocks = own.blocks;
    if (own.block_cells) {
      for (const auto& block : *own.block_cells) {
        target->blocks_targets.push_back(std::make_unique<WriterState::Target>());
        target->blocks_targets.back()->cell = block;
      }
    }
    state->targets.push_back(std::move(target));
  }
  bool several = state->targets.size() > 1;
  state->each([&](WriterState::Target& target) {
    target.cell->claimed_by = who.provenance.empty() ? "unnamed" : std::string(who.provenance);
    for (auto& spare : target.spares) {
      spare.store(target.cell->spare(world.family->oldest_seen(world.token)));
    }
    several = several || target.blocks;
  });
  if (several) {
    state->batch = std::make_shared<BatchState>(kBatchIdle);
    state->each([&](WriterState::Target& target) { target.cell->join_batch(state->batch); });
  }
  world.writers.push_back(state.get());
  return state;
}

}  // namespace

Writer World::claim(MeasurementId measurement, const WriteContext& who) {
  const std::lock_guard lock(impl_->editing);
  return Writer(impl_, claim_cells(*impl_, {&measurement, 1}, who));
}

BatchWriter World::claim(std::span<const MeasurementId> measurements, const WriteContext& who) {
  const std::lock_guard lock(impl_->editing);
  if (measurements.empty()) refuse(impl_->iri, "a batch of nothing", "name the measurements");
  auto state = claim_cells(*impl_, measurements, who);
  if (!state->batch) {
    state->batch = std::make_shared<BatchState>(kBatchIdle);
    state->targets.front()->cell->join_batch(state->batch);
  }
  return BatchWriter(impl_, std::move(state));
}

// ---- queries ----

PreparedPose World::prepare_pose(const PoseQuery& query) const { return {impl_, query}; }
PreparedMotion World::prepare_motion(const PoseQuery& query) const { return {impl_, query}; }

PoseAnswer World::pose(FrameId of, FrameId with_respect_to, Stamp now) const {
  return prepare_pose({.of = of, .with_respect_to = with_respect_to}).latest(now);
}

PoseAnswer World::wait_for_pose(const PoseQuery& query, Duration time_out,
                                const std::function<Stamp()>& clock) const {
  PreparedPose prepared = prepare_pose(query);
  const Stamp begin = clock();
  while (true) {
    const Stamp now = clock();
    PoseAnswer answer = prepared.latest(now);
    if (answer.status == Status::kOk && answer.freshness.rate >= 1.0) return answer;
    if (now - begin >= time_out) {
      answer.status = Status::kTimeOut;
      return answer;
    }
    std::this_thread::sleep_for(kWaitPeriod);
  }
}

// ---- clones ----

World World::clone() const {
  WorldImpl& original = *impl_;
  const std::lock_guard lock(original.editing);
  if (original.ancestors && original.ancestors->depth >= kMaximumCloneDepth) {
    refuse(original.iri,
           "a clone of a clone, " + std::to_string(kMaximumCloneDepth) + " times over",
           "clone an earlier one");
  }
  // Each handle has a spare for its first write after this. One that a write is using up just now
  // is not counted on: there are two, and it is replaced by the next clone, which begins after that
  // write.
  if (!original.writers.empty()) {
    const Epoch needed = original.family->oldest_seen(original.token);
    for (WriterState* const writer : original.writers) {
      writer->each([needed](WriterState::Target& target) {
        for (auto& spare : target.spares) {
          if (!spare.load(std::memory_order_acquire)) {
            spare.store(target.cell->spare(needed), std::memory_order_release);
          }
        }
      });
    }
  }
  const Epoch as_of = original.epoch.fetch_add(1, std::memory_order_seq_cst);
  auto impl = std::make_shared<WorldImpl>(original, original.state, as_of);
  if (original.symbols) {
    impl->inherited = original.symbols->store.snapshot();
  } else {
    impl->inherited = original.inherited;
  }
  // Writes that began before are finished: the clone has them, or never sees them.
  for (const WriterState* const writer : original.writers) {
    const std::uint64_t active = writer->active.load(std::memory_order_seq_cst);
    while ((active & 1) != 0 && writer->active.load(std::memory_order_acquire) == active) {
      std::this_thread::yield();
    }
    complete_histories(*impl, *writer, as_of);
  }
  impl->origin = impl->state;
  return World(std::move(impl));
}

graph::Store& World::graph() {
  {
    const std::lock_guard instant(impl_->instant);  // whoever edits does not hold it up
    if (impl_->symbols) return impl_->symbols->store;
  }
  const std::lock_guard lock(impl_->editing);
  if (!impl_->symbols) {
    auto symbols = std::make_unique<Symbols>(impl_->iri, impl_->family->names, impl_->state,
                                             impl_->inherited ? &*impl_->inherited : nullptr);
    impl_->inherited.reset();
    const std::lock_guard instant(impl_->instant);
    impl_->symbols = std::move(symbols);
  }
  return impl_->symbols->store;
}

}  // namespace sinew::world
