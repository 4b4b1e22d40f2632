#include "sinew/world/space.h"

#include <algorithm>

#include "sinew/world/impl.h"
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
  by_name_.erase(body.name);
  body.alive = false;
  std::erase(unplaced_, id);
}

// The body's shapes where its frame is now; its box in the index, where it has left the old one.
void Space::place(Body& body, Index index, Update& counts) {
  const Place& place = places_[body.place];
  if (!place.answer) {
    take_out(body, index);
    ++counts.unplaced;
    return;
  }
  if (body.is_placed && !place.moved) return;
  ++counts.moved;
  for (std::size_t i = 0; i < body.described.size(); ++i) {
    body.placed[i].placement = compose(place.answer.pose, body.described[i].placement);
  }
  body.is_placed = true;
  if (body.area) return;
  const Bounds3 box = bounds(body.placed);
  boxes_[index] = box;
  if (body.is_indexed && holds(body.indexed, box)) return;
  ++counts.reinserted;
  body.indexed = grown(box, kIndexMargin);
  body.is_indexed = true;
  index_.set(index, body.indexed);
}

// What has gone, and what is attached elsewhere.
void Space::follow_structure() {
  const State state = world_->state();
  for (Index i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    if (!body.alive || !body.object) continue;
    const ObjectRecord& object = state.objects[body.object.index];
    if (!object.alive) {
      take_out(body, i);
      by_name_.erase(body.name);
      body.alive = false;
    } else if (object.frame != body.frame.index) {
      body.frame = {object.frame};
      body.place = kNone;
      body.is_placed = false;
    }
  }
}

void Space::read(Place& place, Stamp now) const {
  const bool constant = place.query.measured_steps() == 0 && place.answer.status == Status::kOk;
  if (constant && place.read_at_structure == structure_) {
    place.moved = false;
    return;
  }
  const PoseAnswer before = place.answer;
  // Asked the other way round: ways are searched from `with_respect_to`, and a body's frame has few
  // relations where the space's may have one for every body.
  place.answer = place.query.latest(now);
  place.answer.pose = invert(place.answer.pose);
  place.moved = before.status != place.answer.status || !same(before.pose, place.answer.pose);
  place.read_at_structure = structure_;
}

Index Space::add_place(FrameId frame) {
  const auto [found, fresh] =
      place_of_.try_emplace(frame.index, static_cast<Index>(places_.size()));
  if (fresh) {
    places_.push_back(
        {.query = world_->prepare_pose({.of = frame_, .with_respect_to = frame, .policy = policy_}),
         .answer = {}});
    read(places_.back(), as_of_);
  }
  return found->second;
}

Space::Update Space::update(Stamp now) {
  as_of_ = now;
  const std::uint64_t structure = world_->structure_version();
  if (structure != structure_) follow_structure();
  structure_ = structure;
  for (Place& place : places_) read(place, now);
  add_place(frame_);  // where regions are asked for most
  for (Body& body : bodies_) {
    if (body.alive && body.place == kNone) body.place = add_place(body.frame);
  }

  Update counts;
  boxes_.resize(bodies_.size());
  unplaced_.clear();
  for (Index i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    if (!body.alive) continue;
    place(body, i, counts);
    if (!body.area && !body.is_placed) unplaced_.push_back({i});
  }
  index_.settle();
  return counts;
}

RegionAnswer Space::search(const std::vector<Shape>& region, Match match) const {
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
  return search(seen, match);
}

RegionAnswer Space::within(BodyId id, Match match) const {
  const Body& area = alive(id);
  if (!area.is_placed) return {.status = status(id), .bodies = {}, .unplaced = {}};
  RegionAnswer answer = search(area.placed, match);
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

const PoseAnswer& Space::pose(BodyId body) const {
  static const PoseAnswer kNever;  // not updated since it was added
  const Index place = alive(body).place;
  return place == kNone ? kNever : places_[place].answer;
}

const std::vector<Shape>& Space::shapes(BodyId body) const { return alive(body).placed; }

FrameId Space::frame_of(BodyId body) const { return alive(body).frame; }
bool Space::is_placed(BodyId body) const { return alive(body).is_placed; }

Status Space::status(BodyId body) const {
  if (alive(body).is_placed) return Status::kOk;
  const Status of_frame = pose(body).status;
  return of_frame == Status::kOk ? Status::kNoData : of_frame;  // added since the last update
}

PoseAnswer Space::pose_of(FrameId frame) const {
  if (const auto found = place_of_.find(frame.index); found != place_of_.end()) {
    return places_[found->second].answer;  // of the last update, as everything else
  }
  return world_->prepare_pose({.of = frame, .with_respect_to = frame_, .policy = policy_})
      .latest(as_of_);
}

}  // namespace sinew::world
