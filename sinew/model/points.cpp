#include "sinew/model/points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sinew::model {
namespace {

using Key = std::pair<int, Id>;

// A position as a step from one point of a body to another, seen from the body's frame.
struct Step {
  Key from, to;
  Vector3 by;
  Id source;
};

struct Search {
  const graph::Terms& terms;
  const graph::Places& places;
  Report& report;
  Points points;

  // Notes where a point is. False when that is known already; then the places must agree.
  bool place(const Key& key, const Vector3& at, Id source, std::string_view what) {
    const auto [known, fresh] = points.emplace(key, at);
    if (fresh) return true;
    const Vector3 d = at - known->second;
    const double apart = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    if (apart > kConsistencyTolerance) {
      report.error(places.find(source), std::string(terms.text(source)),
                   fmt::format("{} <{}> elsewhere than what else is stated of it, {:.3g} m apart",
                               what, terms.text(key.second), apart),
                   "state the place of each point once, or let the ways to it agree");
    }
    return false;
  }
};

std::vector<Step> steps_of(const Structure& structure, const RigidBodies& bodies,
                           const std::vector<std::optional<Pose>>& poses) {
  std::vector<Step> steps;
  for (const Structure::Position& position : structure.positions) {
    const auto& seen_by = poses[position.seen_by];
    if (!seen_by) continue;
    const int body = bodies.of_frame[position.seen_by];
    steps.push_back({{body, position.with_respect_to},
                     {body, position.of},
                     seen_by->R * position.position,
                     position.coordinate});
  }
  return steps;
}

}  // namespace

Points place_points(const Structure& structure, const RigidBodies& bodies,
                    const std::vector<std::optional<Pose>>& poses, const graph::Terms& terms,
                    const graph::Places& places, Report& report) {
  Search search{terms, places, report, {}};
  std::vector<Key> queue;
  for (std::size_t f = 0; f < structure.frames.size(); ++f) {
    const Structure::Frame& frame = structure.frames[f];
    if (!poses[f] || !frame.origin) continue;
    const Key key = {bodies.of_frame[f], frame.origin};
    if (search.place(key, poses[f]->p, frame.iri, "this frame puts its origin")) {
      queue.push_back(key);
    }
  }
  const std::vector<Step> steps = steps_of(structure, bodies, poses);
  std::multimap<Key, std::size_t> at;
  for (std::size_t s = 0; s < steps.size(); ++s) {
    at.emplace(steps[s].from, s);
    at.emplace(steps[s].to, s);
  }
  std::vector<bool> taken(steps.size());
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const Key here = queue[next];
    const auto [first, last] = at.equal_range(here);
    for (auto it = first; it != last; ++it) {
      if (taken[it->second]) continue;
      taken[it->second] = true;
      const Step& step = steps[it->second];
      const bool forward = step.from == here;
      const Key there = forward ? step.to : step.from;
      const Vector3 p = search.points.at(here) + (forward ? step.by : -step.by);
      if (search.place(there, p, step.source, "this position puts")) queue.push_back(there);
    }
  }
  return std::move(search.points);
}

}  // namespace sinew::model
