#include "sinew/world/space.h"

#include <algorithm>

#include "sinew/world/impl.h"
#include "sinew/world/reader.h"
#include "sinew/world/refuse.h"
#include "sinew/world/region_part.h"

namespace sinew::world {
namespace {

Bounds3 grown(const Bounds3& box, double by) {
  const Vector3 margin = {by, by, by};
  return {box.minimum - margin, box.maximum + margin};
}
bool holds(const Bounds3& outer, const Bounds3& inner) {
  return outer.minimum.x <= inner.minimum.x && outer.minimum.y <= inner.minimum.y &&
         outer.minimum.z <= inner.minimum.z && outer.maximum.x >= inner.maximum.x &&
         outer.maximum.y >= inner.maximum.y && outer.maximum.z >= inner.maximum.z;
}
bool same(const Pose& a, const Pose& b) {
  return a.p.x == b.p.x && a.p.y == b.p.y && a.p.z == b.p.z && a.q.x == b.q.x && a.q.y == b.q.y &&
         a.q.z == b.q.z && a.q.w == b.q.w;
}

bool matches(const std::vector<Shape>& body, const std::vector<RegionPart>& region, Match match) {
  if (match == Match::kTouching) {
    return std::any_of(body.begin(), body.end(), [&](const Shape& shape) {
      return std::any_of(region.begin(), region.end(),
                         [&](const RegionPart& part) { return part.touches(shape); });
    });
  }
  return std::all_of(body.begin(), body.end(), [&](const Shape& shape) {
    return std::any_of(region.begin(), region.end(),
                       [&](const RegionPart& part) { return part.holds(shape); });
  });
}

void check(const std::vector<Shape>& shapes, std::string_view iri) {
  if (shapes.empty() || shapes.size() > kMaximumBodyShapes) {
    refuse(iri, "has " + std::to_string(shapes.size()) + " shapes",
           "1 to " + std::to_string(kMaximumBodyShapes));
  }
  for (const Shape& shape : shapes) {
    check_shape(shape.geometry, iri);
    Pose placement = shape.placement;
    if (!normalise(placement)) {
      refuse(iri, "the placement of a shape is no pose", "finite numbers and a unit quaternion");
    }
  }
}

}  // namespace

Space::Space(const World& world, FrameId frame, Policy policy)
    : world_(&world), frame_(frame), policy_(policy) {
  world::alive(world.impl(), world.state(), frame);
}

Space::Space(const Reader& reader, FrameId frame, Policy policy)
    : Space(*reader.world_, frame, policy) {
  reader_ = std::make_shared<const Reader>(reader);
}

PreparedPose Space::prepare(const PoseQuery& query) const {
  return reader_ ? reader_->prepare_pose(query) : world_->prepare_pose(query);
}

BodyId Space::insert(Body body) {
  check(body.described, body.name);
  if (by_name_.contains(body.name)) {
    refuse(body.name, "has shapes already", "all of its shapes at once, or remove the body first");
  }
  const auto index = static_cast<Index>(bodies_.size());
  by_name_.emplace(body.name, index);
  body.alive = true;
  body.placed = body.described;
  if (!body.area) unplaced_.push_back({index});
  added_.push_back(index);
  bodies_.push_back(std::move(body));
  return {index};
}

BodyId Space::add(ObjectId object, std::vector<Shape> shapes) {
  world::alive(world_->impl(), world_->state(), object);
  return insert({.name = world_->name(object),
                 .object = object,
                 .frame = world_->frame_of(object),
                 .described = std::move(shapes)});
}

BodyId Space::add(FrameId frame, std::vector<Shape> shapes) {
  world::alive(world_->impl(), world_->state(), frame);
  return insert({.name = world_->name(frame), .frame = frame, .described = std::move(shapes)});
}

BodyId Space::add_area(std::string_view iri, FrameId frame, std::vector<Shape> shapes) {
  world::alive(world_->impl(), world_->state(), frame);
  return insert(
      {.name = std::string(iri), .area = true, .frame = frame, .described = std::move(shapes)});
}

const Space::Body& Space::alive(BodyId body) const {
  if (body.index >= bodies_.size() || !bodies_[body.index].alive) {
    refuse({}, "body " + std::to_string(body.index) + " is not in this space",
           "a body of this space that was not removed");
  }
  return bodies_[body.index];
}

void Space::take_out(Body& body, Index index) {
  index_.remove(index);
  body.is_indexed = false;
  body.is_placed = false;
}

void Space::remove(BodyId id) {
  alive(id);
  Body& body = bodies_[id.index];
  take_out(body, id.index);
  if (body.place != kNone) std::erase(places_[body.place].bodies, id.index);
  by_name_.erase(body.name);
  body.alive = false;
  unplaced_changed_ = true;
  std::erase(unplaced_, id);
}

// The body's shapes where its frame is now; its box in the index, where it has left the old one.
void Space::place(Body& body, Index index, Update& counts) {
  const Place& place = places_[body.place];
  if (!place.answer) {
    unplaced_changed_ = unplaced_changed_ || body.is_placed || body.is_new;
    take_out(body, index);
    body.is_new = false;
    return;
  }
  if (body.is_placed && !place.moved && !body.is_new) return;
  ++counts.moved;
  for (std::size_t i = 0; i < body.described.size(); ++i) {
    body.placed[i].placement = compose(place.answer.pose, body.described[i].placement);
  }
  unplaced_changed_ = unplaced_changed_ || !body.is_placed;
  body.is_placed = true;
  body.is_new = false;
  if (body.area) return;
  const Bounds3 box = bounds(body.placed);
  boxes_[index] = box;
  if (body.is_indexed && holds(body.indexed, box)) return;
  ++counts.reinserted;
  body.indexed = grown(box, kIndexMargin);
  body.is_indexed = true;
  index_.set(index, body.indexed);
}

// What has gone, and what is attached elsewhere; every way may be another one.
void Space::follow_structure() {
  const State state = world_->state();
  for (Index i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    if (!body.alive || !body.object) continue;
    const ObjectRecord& object = state.objects[body.object.index];
    if (!object.alive) {
      take_out(body, i);
      if (body.place != kNone) std::erase(places_[body.place].bodies, i);
      by_name_.erase(body.name);
      body.alive = false;
      unplaced_changed_ = true;
    } else if (object.frame != body.frame.index) {
      if (body.place != kNone) std::erase(places_[body.place].bodies, i);
      body.frame = {object.frame};
      body.place = kNone;
      body.is_new = true;
      added_.push_back(i);
    }
  }
  for (Place& place : places_) {
    place.is_stale = true;
    plan_anew(place);
  }
  is_watching_ = false;
}

// Whoever may read no longer, or may again, is answered so although nothing was written.
void Space::follow_rights() {
  if (!reader_) return;
  const std::uint64_t changes = reader_->authority_->changes();
  if (changes == rights_) return;
  rights_ = changes;
  for (Place& place : places_) {
    place.query.reset();
    plan_anew(place);
  }
  is_watching_ = false;
}

// Asked the other way round: ways are searched from `with_respect_to`, and a body's frame has few
// relations where the space's may have one for every body.
void Space::plan_anew(Place& place) const {
  try {
    if (place.query) {
      place.query->refresh();
    } else {
      place.query = prepare({.of = frame_, .with_respect_to = place.frame, .policy = policy_});
    }
  } catch (const Error&) {
    if (!reader_) throw;
    place.query.reset();  // it may not read what is on the way; the audit has it
  }
}

// Looks at every count from now on; what is read afterwards is at least as new.
void Space::watch_all() {
  watched_.clear();
  always_.clear();
  for (Index i = 0; i < places_.size(); ++i) {
    if (!places_[i].query) continue;
    const Plan& plan = places_[i].query->plan();
    std::size_t moving = 0;
    bool is_predicted = false, is_timed = false;
    for (const Candidate& candidate : plan.candidates) {
      watched_.push_back({&candidate.cell->changes(), 0, i});
      moving += !candidate.is_static;
      is_predicted = is_predicted || candidate.prediction;
      is_timed = is_timed || candidate.is_timed;
    }
    // Of one that moves it is known when time changes what is said of it (`read`).
    if (is_predicted || (is_timed && moving > 1)) always_.push_back(i);
  }
  std::sort(watched_.begin(), watched_.end(),
            [](const Watched& a, const Watched& b) { return std::less<>()(a.count, b.count); });
  for (Watched& each : watched_) each.seen = each.count->load(std::memory_order_acquire);
  is_watching_ = true;
}

void Space::mark_changed() {
  const auto mark = [this](Index i) {
    if (!places_[i].is_stale) stale_.push_back(i);
    places_[i].is_stale = true;
  };
  for (Watched& each : watched_) {
    const std::uint32_t count = each.count->load(std::memory_order_acquire);
    if (count == each.seen) [[likely]]
      continue;
    each.seen = count;
    mark(each.place);
  }
  for (const Index i : always_) mark(i);
  while (!rechecks_.empty() && rechecks_.top().at <= as_of_) {
    const Recheck due = rechecks_.top();
    rechecks_.pop();
    if (places_[due.place].read_at == due.read_at) mark(due.place);
  }
}

void Space::read(Index index) {
  Place& place = places_[index];
  const PoseAnswer before = place.answer;
  place.is_stale = false;
  place.read_at = as_of_;
  if (!place.query) {
    place.answer = {};
    place.answer.status = Status::kForbidden;
  } else {
    place.answer = place.query->latest_realtime(as_of_);
    place.answer.pose = invert(place.answer.pose);
    for (const Candidate& candidate : place.query->plan().candidates) {
      if (candidate.is_static || !candidate.is_timed || !place.answer) continue;
      const Freshness& fresh = place.answer.freshness;
      Stamp at = Stamp::max();
      if (fresh.expires != Stamp::max() && fresh.expires >= as_of_) {
        at = fresh.expires + Duration(1);
      }
      if (candidate.period != kForever) {
        const Stamp stamp = as_of_ - fresh.currency;
        const auto missed = static_cast<std::int64_t>(fresh.obsolescence);
        at = std::min(at, stamp + (missed + 1) * candidate.period);
      }
      if (at != Stamp::max()) rechecks_.push({at, index, place.read_at});
    }
  }
  place.moved = before.status != place.answer.status || !same(before.pose, place.answer.pose);
}

Index Space::add_place(FrameId frame) {
  const auto [found, fresh] =
      place_of_.try_emplace(frame.index, static_cast<Index>(places_.size()));
  if (fresh) {
    places_.push_back({.frame = frame, .query = std::nullopt});
    plan_anew(places_.back());
    is_watching_ = false;
  }
  return found->second;
}

void Space::list_unplaced() {
  unplaced_.clear();
  unplaced_areas_ = 0;
  for (Index i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].alive || bodies_[i].is_placed) continue;
    bodies_[i].area ? void(++unplaced_areas_) : unplaced_.push_back({i});
  }
  unplaced_changed_ = false;
}

Space::Update Space::update(Stamp now) {
  const bool goes_back = now < as_of_;
  as_of_ = now;
  const std::uint64_t structure = world_->structure_version();
  if (structure != structure_) follow_structure();
  structure_ = structure;
  follow_rights();
  add_place(frame_);  // where regions are asked for most
  std::vector<Index> added;
  for (const Index i : added_) {
    Body& body = bodies_[i];
    if (!body.alive || body.place != kNone) continue;
    body.place = add_place(body.frame);
    places_[body.place].bodies.push_back(i);
    added.push_back(i);
  }
  added_.clear();

  stale_.clear();
  if (!is_watching_ || goes_back) {
    watch_all();
    for (Index i = 0; i < places_.size(); ++i) {
      places_[i].is_stale = true;
      stale_.push_back(i);
    }
  } else {
    mark_changed();
  }
  Update counts;
  boxes_.resize(bodies_.size());
  for (const Index i : stale_) {
    read(i);
    for (const Index body : places_[i].bodies) place(bodies_[body], body, counts);
    places_[i].moved = false;
  }
  for (const Index i : added) {
    if (bodies_[i].alive && bodies_[i].is_new) place(bodies_[i], i, counts);
  }
  if (unplaced_changed_) list_unplaced();
  counts.unplaced = unplaced_.size() + unplaced_areas_;
  index_.settle();
  return counts;
}

RegionAnswer Space::search(const std::vector<Shape>& region, Match match,
                           std::string_view iri) const {
  if (match == Match::kInside && std::any_of(region.begin(), region.end(), is_open_mesh)) {
    refuse(iri, "a mesh of the region is open: nothing is inside it",
           "a mesh that is closed, bounds, or what touches the region");
  }
  RegionAnswer answer{.status = Status::kOk, .bodies = {}, .unplaced = unplaced_};
  candidates_.clear();
  index_.search(grown(bounds(region), kTouchingDistance), candidates_);
  std::sort(candidates_.begin(), candidates_.end());
  // Most are decided by their boxes; their shapes are looked at where a box is across the edge.
  std::vector<RegionPart> parts(region.begin(), region.end());
  for (const Index i : candidates_) {
    bool within = false, apart = true;
    const TurnedBox box = turned_box(boxes_[i]);
    for (const RegionPart& part : parts) {
      const RegionPart::Verdict verdict = part.judge(box);
      within = within || verdict == RegionPart::Verdict::kWithin;
      apart = apart && verdict == RegionPart::Verdict::kApart;
    }
    if (within || (!apart && matches(bodies_[i].placed, parts, match))) {
      answer.bodies.push_back({i});
    }
  }
  return answer;
}

RegionAnswer Space::within(FrameId frame, const std::vector<Shape>& region, Match match) const {
  check(region, "the region");
  const PoseAnswer at = pose_of(frame);
  if (!at) return {.status = at.status, .bodies = {}, .unplaced = {}};
  std::vector<Shape> seen;
  for (const Shape& shape : region) seen.push_back(placed(at.pose, shape));
  return search(seen, match, "the region");
}

RegionAnswer Space::within(BodyId id, Match match) const {
  const Body& area = alive(id);
  if (!area.is_placed) return {.status = status(id), .bodies = {}, .unplaced = {}};
  RegionAnswer answer = search(area.placed, match, area.name);
  std::erase(answer.bodies, id);
  return answer;
}

RegionAnswer Space::within(std::string_view area_iri, Match match) const {
  const BodyId area = find(area_iri);
  if (!area) refuse(area_iri, "is no area or body of this space", "add_area, or add");
  return within(area, match);
}

BodyId Space::find(std::string_view iri) const {
  const auto found = by_name_.find(std::string(iri));
  return found == by_name_.end() ? BodyId{} : BodyId{found->second};
}

std::string Space::name(BodyId body) const { return alive(body).name; }

std::vector<BodyId> Space::bodies() const {
  std::vector<BodyId> result;
  for (Index i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].alive && !bodies_[i].area) result.push_back({i});
  }
  return result;
}

// A place that nothing was written of has aged since it was read.
PoseAnswer Space::aged(const Place& place) const {
  PoseAnswer answer = place.answer;
  if (answer && place.query->measured_steps() > 0) {
    answer.freshness.currency += as_of_ - place.read_at;
    answer.freshness.timeliness += as_of_ - place.read_at;
  }
  return answer;
}

PoseAnswer Space::pose(BodyId body) const {
  const Index place = alive(body).place;
  return place == kNone ? PoseAnswer() : aged(places_[place]);  // kNone: not updated since it came
}

const std::vector<Shape>& Space::shapes(BodyId body) const { return alive(body).placed; }

FrameId Space::frame_of(BodyId body) const { return alive(body).frame; }
bool Space::is_placed(BodyId body) const { return alive(body).is_placed; }

Status Space::status(BodyId body) const {
  if (alive(body).is_placed) return Status::kOk;
  const Status of_frame = pose(body).status;
  return of_frame == Status::kOk ? Status::kNoData : of_frame;  // added since the last update
}

std::vector<MeasurementId> Space::read_for(std::span<const BodyId> bodies, FrameId frame) const {
  std::vector<MeasurementId> found;
  const auto add = [&found](const PreparedPose& query) {
    const auto read = measurements_of(query.plan());
    found.insert(found.end(), read.begin(), read.end());
  };
  for (const BodyId body : bodies) {
    const Index place = alive(body).place;
    if (place != kNone && places_[place].query) add(*places_[place].query);
  }
  if (frame) add(prepare({.of = frame, .with_respect_to = frame_, .policy = policy_}));
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

PoseAnswer Space::pose_of(FrameId frame) const {
  if (const auto found = place_of_.find(frame.index); found != place_of_.end()) {
    return aged(places_[found->second]);  // of the last update, as everything else
  }
  try {
    return prepare({.of = frame, .with_respect_to = frame_, .policy = policy_}).latest(as_of_);
  } catch (const Error&) {
    if (!reader_) throw;
    PoseAnswer refused;
    refused.status = Status::kForbidden;
    return refused;
  }
}

}  // namespace sinew::world
