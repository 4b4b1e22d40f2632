#include "sinew/world/edit.h"

#include <optional>
#include <thread>

#include "sinew/world/impl.h"
#include "sinew/world/reading.h"
#include "sinew/world/refuse.h"
#include "sinew/world/symbols.h"

namespace sinew::world {
namespace {

// How often an edit, which is in no hurry, looks at a pose that writers in a hurry change.
constexpr int kEditAttempts = 1000;

// The last segment of an IRI.
std::string_view short_name(std::string_view iri) {
  const std::size_t at = iri.find_last_of("#/:");
  return at == std::string_view::npos ? iri : iri.substr(at + 1);
}

}  // namespace

Edit::Edit(std::shared_ptr<WorldImpl> world)
    : world_(std::move(world)),
      lock_(world_->editing),
      next_(world_->published()),
      token_(fresh_token()),
      old_measurements_(next_.measurements.size()),
      described_(world_->symbols != nullptr) {}

Edit::~Edit() = default;

Name Edit::new_name(std::string_view iri) {
  return new_name(iri, world_->family->names.ask_for(iri));
}

Name Edit::new_name(std::string_view iri, std::uint32_t asked) {
  if (iri.empty()) refuse(iri, "an element without a name", "give it an IRI");
  const Name name = world_->family->names.intern(iri, asked);
  const Element element = next_.find(name);
  if (element.kind != ElementKind::kNothing) {
    refuse(iri, "there is a " + std::string(to_string(element.kind)) + " of this name",
           "choose another IRI, or remove that one first");
  }
  return name;
}

FrameRecord& Edit::to_change(FrameId frame) {
  if (frame.index < next_.frames.size()) {
    FrameRecord& record = next_.frames.edit(frame.index, token_);
    if (record.alive) return record;
  }
  alive(*world_, next_, frame);  // says what is wrong
  return next_.frames.edit(frame.index, token_);
}

FrameId Edit::add_frame(std::string_view iri) {
  const Name name = new_name(iri);
  const auto index = static_cast<Index>(next_.frames.size());
  next_.frames.edit(index, token_) = {name, true, kNone};
  next_.by_name.edit(name.value, token_) = {ElementKind::kFrame, index};
  touch(ElementKind::kFrame, index);
  return {index};
}

ObjectId Edit::add_object(std::string_view iri, FrameId frame, std::string_view model) {
  alive(*world_, next_, frame);
  const Name name = new_name(iri);
  const auto index = static_cast<Index>(next_.objects.size());
  const Name of_model = model.empty() ? Name{} : world_->family->names.intern(model);
  next_.objects.edit(index, token_) = {name, of_model, frame.index, true};
  next_.by_name.edit(name.value, token_) = {ElementKind::kObject, index};
  touch(ElementKind::kObject, index);
  return {index};
}

RelationId Edit::add_relation(const RelationSpec& spec) {
  const std::uint32_t asked = world_->family->names.ask_for(spec.name);
  const bool property = spec.kind == RelationKind::kProperty;
  FrameRecord& of = to_change(spec.of);
  if (property != (spec.with_respect_to == FrameId{})) {
    refuse(spec.name,
           property ? "a property with a frame that it is seen from"
                    : "a relation without a frame that it is seen from",
           "relations have two frames, properties one");
  }
  FrameRecord* with_respect_to = nullptr;
  if (!property) {
    with_respect_to = &to_change(spec.with_respect_to);
    if (spec.of == spec.with_respect_to) {
      refuse(spec.name, "a relation of a frame with itself", "name two frames");
    }
  }
  Pose placement = spec.placement;
  if (!normalise(placement)) {
    refuse(spec.name, "a placement that is not finite or whose quaternion is not of unit length",
           "a rigid placement");
  }
  const Name name = new_name(spec.name, asked);
  const auto index = static_cast<Index>(next_.relations.size());
  RelationRecord record{.name = name,
                        .of = spec.of.index,
                        .with_respect_to = spec.with_respect_to.index,
                        .kind = spec.kind,
                        .alive = true,
                        .placement = placement};
  record.next_at_of = of.first_relation;
  of.first_relation = index;
  if (with_respect_to) {
    record.next_at_with_respect_to = with_respect_to->first_relation;
    with_respect_to->first_relation = index;
  }
  next_.relations.edit(index, token_) = record;
  next_.by_name.edit(name.value, token_) = {ElementKind::kRelation, index};
  touch(ElementKind::kRelation, index);
  return {index};
}

MeasurementId Edit::add_measurement(const MeasurementSpec& spec) {
  const RelationRecord relation = alive(*world_, next_, spec.relation);
  const bool joint =
      relation.kind == RelationKind::kRevolute || relation.kind == RelationKind::kPrismatic;
  const bool of_joint = spec.quantity == Quantity::kJointPosition ||
                        spec.quantity == Quantity::kJointVelocity ||
                        spec.quantity == Quantity::kJointAcceleration;
  const bool of_free = spec.quantity == Quantity::kPose || spec.quantity == Quantity::kTwist ||
                       spec.quantity == Quantity::kAcceleration;
  if ((of_joint && !joint) || (of_free && relation.kind != RelationKind::kFree)) {
    refuse(spec.name,
           "a " + std::string(to_string(spec.quantity)) + " cannot measure the relation " +
               world_->family->names.text(relation.name),
           "poses, twists and accelerations measure free relations, joint quantities joints");
  }
  const std::uint32_t values =
      spec.quantity == Quantity::kOther ? spec.values : size_of(spec.quantity);
  if (values == 0 || values > kMaximumValues) {
    refuse(spec.name, "a measurement of " + std::to_string(values) + " numbers",
           "1 to " + std::to_string(kMaximumValues));
  }
  if (spec.capacity == 0 || spec.capacity > kMaximumCapacity) {
    refuse(spec.name, "a ring of " + std::to_string(spec.capacity) + " entries",
           "1 to " + std::to_string(kMaximumCapacity));
  }
  const Name name = new_name(spec.name);
  const auto index = static_cast<Index>(next_.measurements.size());
  const std::shared_ptr<const BlockSet> blocks =
      make_block_set(std::string(spec.name), spec.blocks, spec.quantity == Quantity::kPose, values);
  const Epoch epoch = world_->epoch.load();
  auto block_cells = std::make_shared<std::vector<std::shared_ptr<Cell>>>();
  for (std::size_t i = 0; blocks && i < blocks->blocks.size(); ++i) {
    new_name(blocks->blocks[i].name);
    block_cells->push_back(
        std::make_shared<Cell>(blocks->blocks[i].words(), kBlockCapacity, world_->token, epoch));
  }
  // One slot is always under the writer's pen.
  const std::uint32_t capacity = std::min(spec.capacity + 1, kMaximumCapacity);
  next_.measurements.edit(index, token_) = {
      .name = name,
      .relation = spec.relation.index,
      .next = relation.first_measurement,
      .quantity = spec.quantity,
      .alive = true,
      .cell =
          std::make_shared<Cell>(values, capacity, world_->token, epoch, world_->family->changes),
      .model = std::make_shared<const MeasurementModel>(spec.model),
      .blocks = blocks,
      .block_cells = blocks ? block_cells : nullptr,
      .history = nullptr,
      .published = nullptr};
  if (spec.keep_all) {
    MeasurementRecord& record = next_.measurements.edit(index, token_);
    record.history = std::make_shared<const History>();
    record.published = std::make_shared<PublishedHistory>(world_->family->readers, record.history);
  }
  next_.relations.edit(spec.relation.index, token_).first_measurement = index;
  next_.by_name.edit(name.value, token_) = {ElementKind::kMeasurement, index};
  touch(ElementKind::kMeasurement, index);
  return {index};
}

void Edit::set_value(MeasurementId measurement, Stamp stamp, std::span<const double> values) {
  const MeasurementRecord& record = alive(*world_, next_, measurement);
  std::vector<double> checked(values.begin(), values.end());
  if (measurement.index < old_measurements_) {
    refuse(world_->family->names.text(record.name), "a first value for a measurement in use",
           "World::write");
  }
  if (checked.size() != record.cell->values() || !acceptable(record.quantity, checked)) {
    refuse(world_->family->names.text(record.name),
           "a first value that is not a " + std::string(to_string(record.quantity)),
           "finite numbers, as many as the quantity has; quaternions of unit length");
  }
  Ring* none = nullptr;
  record.cell->append(stamp, checked.data(), world_->epoch.load(), none);
  for (std::size_t i = 0; record.blocks && i < record.blocks->blocks.size(); ++i) {
    double numbers[kMaximumValues];
    convert(record.blocks->blocks[i], checked.data(), numbers);
    (*record.block_cells)[i]->append(stamp, numbers, world_->epoch.load(), none);
  }
}

MeasurementId Edit::add_static(std::string_view relation_iri, FrameId of, FrameId with_respect_to,
                               const Pose& pose, std::string_view provenance) {
  const RelationId relation =
      add_relation({.name = relation_iri, .of = of, .with_respect_to = with_respect_to});
  const MeasurementId measurement =
      add_measurement({.name = std::string(relation_iri) + "/value",
                       .relation = relation,
                       .model = {.life_cycle = Static{}, .provenance = std::string(provenance)},
                       .capacity = 1});
  double values[7];
  store_pose(pose, values);
  set_value(measurement, Stamp(), values);
  return measurement;
}

void Edit::unlink(Index relation, Index frame) {
  Index* slot = &next_.frames.edit(frame, token_).first_relation;
  while (*slot != relation) {
    RelationRecord& at = next_.relations.edit(*slot, token_);
    slot = at.of == frame ? &at.next_at_of : &at.next_at_with_respect_to;
  }
  const RelationRecord& gone = next_.relations[relation];
  *slot = gone.of == frame ? gone.next_at_of : gone.next_at_with_respect_to;
}

void Edit::remove(MeasurementId measurement) {
  const MeasurementRecord record = alive(*world_, next_, measurement);
  Index* slot = &next_.relations.edit(record.relation, token_).first_measurement;
  while (*slot != measurement.index) slot = &next_.measurements.edit(*slot, token_).next;
  *slot = record.next;
  MeasurementRecord& gone = next_.measurements.edit(measurement.index, token_);
  gone.alive = false;
  next_.by_name.edit(record.name.value, token_) = {};
  touch(ElementKind::kMeasurement, measurement.index);
}

void Edit::remove(RelationId relation) {
  const RelationRecord record = alive(*world_, next_, relation);
  while (true) {
    const Index measurement = next_.relations[relation.index].first_measurement;
    if (measurement == kNone) break;
    remove(MeasurementId{measurement});
  }
  unlink(relation.index, record.of);
  if (record.with_respect_to != kNone) unlink(relation.index, record.with_respect_to);
  next_.relations.edit(relation.index, token_).alive = false;
  next_.by_name.edit(record.name.value, token_) = {};
  touch(ElementKind::kRelation, relation.index);
}

void Edit::remove(ObjectId object) {
  const ObjectRecord record = alive(*world_, next_, object);
  next_.objects.edit(object.index, token_).alive = false;
  next_.by_name.edit(record.name.value, token_) = {};
  touch(ElementKind::kObject, object.index);
}

void Edit::remove(FrameId frame) {
  const FrameRecord record = alive(*world_, next_, frame);
  for (std::size_t i = 0; i < next_.objects.size(); ++i) {
    const ObjectRecord& object = next_.objects[i];
    if (object.alive && object.frame == frame.index) {
      refuse(world_->family->names.text(record.name),
             "the object " + world_->family->names.text(object.name) + " is attached to it",
             "remove the object, or move it to another frame, first");
    }
  }
  while (next_.frames[frame.index].first_relation != kNone) {
    remove(RelationId{next_.frames[frame.index].first_relation});
  }
  next_.frames.edit(frame.index, token_).alive = false;
  next_.by_name.edit(record.name.value, token_) = {};
  touch(ElementKind::kFrame, frame.index);
}

void Edit::set_attachment(RelationId relation, bool is_attachment, bool is_suspended) {
  alive(*world_, next_, relation);
  RelationRecord& record = next_.relations.edit(relation.index, token_);
  record.attachment = is_attachment;
  record.suspended = is_suspended;
  touch(ElementKind::kRelation, relation.index);
}

void Edit::set_frame(ObjectId object, FrameId frame) {
  alive(*world_, next_, object);
  alive(*world_, next_, frame);
  next_.objects.edit(object.index, token_).frame = frame.index;
  touch(ElementKind::kObject, object.index);
}

PoseAnswer Edit::pose(FrameId of, FrameId with_respect_to, Stamp now) const {
  const auto plan = make_plan(
      next_, world_->family->names, [this](std::uint64_t owner) { return world_->as_of(owner); },
      {.of = of, .with_respect_to = with_respect_to}, false, 0);
  PoseAnswer answer;
  for (int attempt = 0; attempt < kEditAttempts; ++attempt) {
    read_latest(*plan, now, Policy::kInform, answer);
    if (answer.status != Status::kBusy) break;
    std::this_thread::yield();
  }
  return answer;
}

RelationId Edit::attach_with(FrameId frame, FrameId parent, const Pose& pose, Stamp now,
                             std::string_view provenance) {
  const Names& names = world_->family->names;
  std::string iri = names.text(next_.frames[frame.index].name) + "/attached-to/" +
                    std::string(short_name(names.text(next_.frames[parent.index].name)));
  while (next_.find(names.find(iri)).kind != ElementKind::kNothing) iri += "-";
  const MeasurementId measurement = add_static(iri, frame, parent, pose, provenance);
  (void)now;
  const Index relation = next_.measurements[measurement.index].relation;
  next_.relations.edit(relation, token_).attachment = true;
  return {relation};
}

RelationId Edit::attach(FrameId frame, FrameId parent, Stamp now, std::string_view provenance) {
  alive(*world_, next_, frame);
  alive(*world_, next_, parent);
  const Names& names = world_->family->names;
  const PoseAnswer answer = pose(frame, parent, now);
  if (!answer) {
    refuse(names.text(next_.frames[frame.index].name),
           "its pose with respect to " + names.text(next_.frames[parent.index].name) +
               " is not known: " + std::string(to_string(answer.status)),
           "measure it before it is attached");
  }
  // What places the frame so far: an attachment ends, other relations wait.
  std::vector<Index> attachments;
  for (Index at = next_.frames[frame.index].first_relation; at != kNone;) {
    const RelationRecord& relation = next_.relations[at];
    const bool is_of = relation.of == frame.index;
    const Index next = is_of ? relation.next_at_of : relation.next_at_with_respect_to;
    if (is_of && relation.kind != RelationKind::kProperty) {
      if (relation.attachment) {
        attachments.push_back(at);
      } else if (!relation.suspended) {
        next_.relations.edit(at, token_).suspended = true;
        touch(ElementKind::kRelation, at);
      }
    }
    at = next;
  }
  for (const Index at : attachments) remove(RelationId{at});
  // A frame that also carries the parent would be attached to itself.
  if (pose(frame, parent, now).status != Status::kNotConnected) {
    refuse(names.text(next_.frames[frame.index].name),
           "it carries " + names.text(next_.frames[parent.index].name) +
               ", or is linked to it by a relation in which it is what others are seen from",
           "attach the other way round");
  }
  return attach_with(frame, parent, answer.pose, now, provenance);
}

RelationId Edit::detach(FrameId frame, FrameId parent, Stamp now, std::string_view provenance) {
  alive(*world_, next_, frame);
  alive(*world_, next_, parent);
  const Names& names = world_->family->names;
  const std::string& frame_name = names.text(next_.frames[frame.index].name);
  Index attachment = kNone;
  std::vector<Index> waiting;
  for (Index at = next_.frames[frame.index].first_relation; at != kNone;) {
    const RelationRecord& relation = next_.relations[at];
    const bool is_of = relation.of == frame.index;
    if (is_of && relation.attachment) attachment = at;
    if (is_of && relation.suspended && relation.kind == RelationKind::kFree) waiting.push_back(at);
    at = is_of ? relation.next_at_of : relation.next_at_with_respect_to;
  }
  if (attachment == kNone) {
    refuse(frame_name, "it is not attached to anything", "attach it first");
  }
  const PoseAnswer answer = pose(frame, parent, now);
  if (!answer) {
    refuse(frame_name,
           "its pose with respect to " + names.text(next_.frames[parent.index].name) +
               " is not known: " + std::string(to_string(answer.status)),
           "detach it towards a frame that it is linked to");
  }
  // Every relation that takes over gets the pose as it is now, in a measurement of whoever
  // detaches: the providers' own measurements stay theirs, and win as soon as they are newer. One
  // that is constant no longer holds and stays suspended.
  struct Revived {
    Index relation;
    Pose pose;
  };
  std::vector<Revived> revived;
  for (const Index at : waiting) {
    const Index measurement = next_.relations[at].first_measurement;
    if (measurement == kNone ||
        std::holds_alternative<Static>(next_.measurements[measurement].model->life_cycle)) {
      continue;
    }
    const PoseAnswer there = pose(frame, {next_.relations[at].with_respect_to}, now);
    if (there) revived.push_back({at, there.pose});
  }
  remove(RelationId{attachment});
  // What is linked to it now is carried by it.
  const bool carries = pose(frame, parent, now).status != Status::kNotConnected;
  RelationId taking_over;
  for (const auto& [at, X] : revived) {
    RelationRecord& relation = next_.relations.edit(at, token_);
    relation.suspended = false;
    touch(ElementKind::kRelation, at);
    if (relation.with_respect_to == parent.index) taking_over = {at};
    const std::string iri = names.text(relation.name) + "/released";
    if (const Element old = next_.find(names.find(iri)); old.kind == ElementKind::kMeasurement) {
      remove(MeasurementId{old.index});
    }
    const MeasurementId released = add_measurement(
        {.name = iri, .relation = {at}, .model = {.provenance = std::string(provenance)}});
    double values[7];
    store_pose(X, values);
    set_value(released, now, values);
  }
  if (taking_over) return taking_over;
  if (carries) {
    refuse(frame_name,
           "it carries " + names.text(next_.frames[parent.index].name) +
               ", or is linked to it by a relation in which it is what others are seen from",
           "detach it towards a frame that it does not carry");
  }
  std::string iri = frame_name + "/left-at/" +
                    std::string(short_name(names.text(next_.frames[parent.index].name)));
  while (next_.find(names.find(iri)).kind != ElementKind::kNothing) iri += "-";
  const RelationId relation = add_relation({.name = iri, .of = frame, .with_respect_to = parent});
  const MeasurementId value = add_measurement({.name = iri + "/value",
                                               .relation = relation,
                                               .model = {.provenance = std::string(provenance)}});
  double values[7];
  store_pose(answer.pose, values);
  set_value(value, now, values);
  return relation;
}

FrameId Edit::find_frame(std::string_view iri) const {
  const Element element = next_.find(world_->family->names.find(iri));
  return element.kind == ElementKind::kFrame ? FrameId{element.index} : FrameId{};
}

ObjectId Edit::find_object(std::string_view iri) const {
  const Element element = next_.find(world_->family->names.find(iri));
  return element.kind == ElementKind::kObject ? ObjectId{element.index} : ObjectId{};
}

void Edit::commit_keeping_lock(graph::Transaction* facts) {
  if (!lock_) refuse(world_->iri, "an edit that was committed before", "begin a new one");
  std::optional<graph::Transaction> own;
  if (world_->symbols) {
    if (!facts) facts = &own.emplace(world_->symbols->store.begin());
    world_->symbols->update(*facts, world_->state, next_, touched_);
  }
  const std::lock_guard instant(world_->instant);
  if (facts) facts->commit();
  world_->publish(std::move(next_));
}

void Edit::commit_with(graph::Transaction& facts) {
  commit_keeping_lock(&facts);
  lock_.unlock();
}

void Edit::commit() {
  commit_keeping_lock();
  lock_.unlock();
}

}  // namespace sinew::world
