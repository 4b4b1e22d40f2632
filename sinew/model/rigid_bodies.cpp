#include "sinew/model/rigid_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sinew/model/rotation.h"

namespace sinew::model {
namespace {

// Disjoint sets with path halving (Tarjan 1975).
class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) { parent_[std::max(find(a), find(b))] = std::min(find(a), find(b)); }

 private:
  std::vector<int> parent_;
};

void add_edge(RigidBodies& bodies, int from, int to, const Pose& pose, Id source) {
  bodies.edges[from].push_back({to, pose, source, true});
  bodies.edges[to].push_back({from, math::invert(pose), source, false});
}

bool has_edge(const RigidBodies& bodies, int from, int to) {
  return std::any_of(bodies.edges[from].begin(), bodies.edges[from].end(),
                     [&](const RigidBodies::Edge& edge) { return edge.to == to; });
}

double difference(const Pose& a, const Pose& b) {
  double largest = 0;
  const auto compare = [&](double x, double y) { largest = std::max(largest, std::abs(x - y)); };
  compare(a.R.xx, b.R.xx), compare(a.R.xy, b.R.xy), compare(a.R.xz, b.R.xz);
  compare(a.R.yx, b.R.yx), compare(a.R.yy, b.R.yy), compare(a.R.yz, b.R.yz);
  compare(a.R.zx, b.R.zx), compare(a.R.zy, b.R.zy), compare(a.R.zz, b.R.zz);
  compare(a.p.x, b.p.x), compare(a.p.y, b.p.y), compare(a.p.z, b.p.z);
  return largest;
}

}  // namespace

RigidBodies find_rigid_bodies(const Structure& structure) {
  const int frames = static_cast<int>(structure.frames.size());
  const int links = static_cast<int>(structure.links.size());
  RigidBodies bodies;
  bodies.edges.resize(frames);
  Sets sets(links + frames);  // links first, so that a body is known by its first link
  for (int f = 0; f < frames; ++f) {
    if (structure.frames[f].link != kNone) sets.join(structure.frames[f].link, links + f);
  }
  for (const Structure::ConstantPose& pose : structure.poses) {
    sets.join(links + pose.of, links + pose.with_respect_to);
    add_edge(bodies, pose.with_respect_to, pose.of, pose.pose, pose.coordinate);
  }
  for (const Structure::Joint& joint : structure.joints) {
    if (joint.kind != JointKind::kFixed) continue;
    sets.join(links + joint.parent, links + joint.child);
    // Without a stated pose, the attachments of a fixed joint are at the same place.
    if (!has_edge(bodies, joint.parent, joint.child)) {
      add_edge(bodies, joint.parent, joint.child, identity_pose(), joint.iri);
    }
  }
  std::vector<int> number(links + frames, kNone);
  const auto body_of = [&](int element) {
    int& body = number[sets.find(element)];
    if (body == kNone) {
      body = bodies.count++;
      bodies.frames.emplace_back();
      bodies.links.emplace_back();
    }
    return body;
  };
  for (int l = 0; l < links; ++l) {
    bodies.of_link.push_back(body_of(l));
    bodies.links[bodies.of_link[l]].push_back(l);
  }
  for (int f = 0; f < frames; ++f) {
    bodies.of_frame.push_back(body_of(links + f));
    bodies.frames[bodies.of_frame[f]].push_back(f);
  }
  return bodies;
}

void place_frames(const Structure& structure, const RigidBodies& bodies, const graph::Terms& terms,
                  const graph::Places& places, int frame, const Pose& pose,
                  std::vector<std::optional<Pose>>& poses, Report& report) {
  std::vector<int> queue = {frame};
  poses[frame] = pose;
  for (std::size_t at = 0; at < queue.size(); ++at) {
    for (const RigidBodies::Edge& edge : bodies.edges[queue[at]]) {
      const Pose here = math::compose(*poses[queue[at]], edge.pose);
      if (!poses[edge.to]) {
        poses[edge.to] = here;
        queue.push_back(edge.to);
      } else if (edge.forward && difference(here, *poses[edge.to]) > kConsistencyTolerance) {
        report.error(places.find(edge.source), std::string(terms.text(edge.source)),
                     fmt::format("this pose of <{}> differs by {:.3g} from what other poses say",
                                 terms.text(structure.frames[edge.to].iri),
                                 difference(here, *poses[edge.to])),
                     "state each pose once, or let the ways to a frame agree");
      }
    }
  }
}

}  // namespace sinew::model
