#include "sinew/model/spanning_tree.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/model/names.h"

namespace sinew::model {
namespace {

// A message lists no more elements than these.
constexpr std::size_t kMaximumListed = 12;

struct Search {
  const Structure& structure;
  const RigidBodies& bodies;
  const graph::Terms& terms;
  const graph::Places& places;
  Report& report;

  std::string_view text(Id id) const { return terms.text(id); }
  void error(Id node, std::string what, std::string remedy) const {
    report.error(node ? places.find(node) : Place{}, node ? std::string(text(node)) : "",
                 std::move(what), std::move(remedy));
  }
  void warning(Id node, std::string what, std::string remedy) const {
    report.warning(places.find(node), std::string(text(node)), std::move(what), std::move(remedy));
  }
  std::string list(const std::vector<Id>& ids) const {
    std::string names;
    for (std::size_t i = 0; i < ids.size() && i < kMaximumListed; ++i) {
      names += fmt::format("{}<{}>", names.empty() ? "" : ", ", text(ids[i]));
    }
    if (ids.size() > kMaximumListed) {
      names += fmt::format(" and {} more", ids.size() - kMaximumListed);
    }
    return names;
  }
};

std::vector<Id> iris_of(const auto& elements) {
  std::vector<Id> iris;
  for (const auto& element : elements) iris.push_back(element.iri);
  return iris;
}

int body_of_link(const Search& in, int link) { return in.bodies.of_link[link]; }

// The element of that name, or an error.
Id resolve(const Search& in, const std::string& name, std::string_view role,
           const std::vector<std::vector<Id>>& groups) {
  const Match match = find_by_name(in.terms, name, groups);
  if (match.element) return match.element;
  if (match.candidates.empty()) {
    in.error({}, fmt::format("the {} '{}' is nothing in this model", role, name),
             fmt::format("name one of its links: {}", in.list(iris_of(in.structure.links))));
  } else {
    in.error({}, fmt::format("the {} '{}' may be any of {}", role, name, in.list(match.candidates)),
             "give its full IRI");
  }
  return {};
}

// The first link of a body that no fixed joint leads to; one that carries joints, if there is one.
int first_link(const Search& in, int body) {
  const auto& links = in.bodies.links[body];
  std::vector<bool> led_to(in.structure.links.size()), carries(in.structure.links.size());
  for (const Structure::Joint& joint : in.structure.joints) {
    const int parent = in.structure.frames[joint.parent].link;
    const int child = in.structure.frames[joint.child].link;
    carries[parent] = true;
    if (joint.directed) {
      led_to[child] = true;
    } else {
      carries[child] = true;
    }
  }
  for (const int link : links) {
    if (carries[link] && !led_to[link]) return link;
  }
  for (const int link : links) {
    if (!led_to[link]) return link;
  }
  return links.front();
}

// The only body that no joint leads to; an error when there is none, or more than one.
int only_root(const Search& in) {
  std::vector<bool> led_to(in.bodies.count);
  for (const Structure::Joint& joint : in.structure.joints) {
    if (joint.kind != JointKind::kFixed && joint.directed) {
      led_to[in.bodies.of_frame[joint.child]] = true;
    }
  }
  std::vector<Id> roots;
  int root = kNone;
  for (int body = 0; body < in.bodies.count; ++body) {
    if (led_to[body] || in.bodies.links[body].empty()) continue;
    root = body;
    roots.push_back(in.structure.links[first_link(in, body)].iri);
  }
  if (roots.size() == 1) return root;
  if (roots.empty()) {
    in.error({}, in.structure.links.empty() ? "the model has no links" : "the model has no root",
             in.structure.links.empty()
                 ? "load a model with links (SimplicialComplex), joints and frames"
                 : "its joints form a loop; name the base");
  } else {
    in.error(roots.front(), fmt::format("the model has {} roots: {}", roots.size(), in.list(roots)),
             "name the base, or connect them with a joint or a pose");
  }
  return kNone;
}

// Sets the root from the option, or from the model.
bool choose_root(const Search& in, const std::string& base, SpanningTree& tree) {
  if (base.empty()) {
    tree.root_body = only_root(in);
    if (tree.root_body == kNone) return false;
    tree.root_link = first_link(in, tree.root_body);
  } else {
    const Id element =
        resolve(in, base, "base", {iris_of(in.structure.links), iris_of(in.structure.frames)});
    if (!element) return false;
    tree.root_link = in.structure.find_link(element);
    if (tree.root_link == kNone) {
      tree.root_frame = in.structure.find_frame(element);
      tree.root_body = in.bodies.of_frame[tree.root_frame];
      const int link = in.structure.frames[tree.root_frame].link;
      tree.root_link = link != kNone ? link : first_link(in, tree.root_body);
    } else {
      tree.root_body = body_of_link(in, tree.root_link);
    }
  }
  bool guessed = false;
  if (tree.root_frame == kNone) {
    tree.root_frame = root_frame_of(in.structure, tree.root_link, &guessed);
  }
  if (tree.root_frame == kNone) {
    const Id link = in.structure.links[tree.root_link].iri;
    in.error(link, "the base has no frame", "give it a Frame among its simplices");
    return false;
  }
  if (guessed) {
    in.warning(in.structure.links[tree.root_link].iri,
               fmt::format("the model does not say which frame of the base is its own: <{}> is "
                           "taken, and what is seen from the base is seen from it",
                           in.text(in.structure.frames[tree.root_frame].iri)),
               "name a frame as the base, or place all other frames of the link with respect to "
               "one");
  }
  return true;
}

void report_loop(const Search& in, const SpanningTree& tree, int joint,
                 const std::vector<int>& step_of_body) {
  // The joints from both ends up to where the ways meet.
  const Structure::Joint& closing = in.structure.joints[joint];
  std::vector<int> ways[2];
  int end = 0;
  for (const int frame : {closing.parent, closing.child}) {
    for (int s = step_of_body[in.bodies.of_frame[frame]]; s != kNone;
         s = tree.steps[s].predecessor) {
      ways[end].push_back(s);
    }
    ++end;
  }
  while (!ways[0].empty() && !ways[1].empty() && ways[0].back() == ways[1].back()) {
    ways[0].pop_back();
    ways[1].pop_back();
  }
  std::vector<Id> joints = {closing.iri};
  for (const auto& way : ways) {
    for (const int step : way) joints.push_back(in.structure.joints[tree.steps[step].joint].iri);
  }
  in.error(closing.iri, fmt::format("the joints form a loop: {}", in.list(joints)),
           "leave out one of them: kinematic loops cannot be solved yet");
}

void check_that_joints_move(const Search& in) {
  for (const Structure::Joint& joint : in.structure.joints) {
    if (joint.kind == JointKind::kFixed) continue;
    if (in.bodies.of_frame[joint.parent] != in.bodies.of_frame[joint.child]) continue;
    in.error(joint.iri, "the joint connects two frames of the same rigid body",
             "remove the constant pose or the fixed joint that makes them one, or the joint");
  }
}

// Depth first from the root, each body's joints in the order of the model.
void walk(const Search& in, SpanningTree& tree) {
  std::vector<std::vector<int>> joints_of(in.bodies.count);
  for (int j = 0; j < static_cast<int>(in.structure.joints.size()); ++j) {
    const Structure::Joint& joint = in.structure.joints[j];
    if (joint.kind == JointKind::kFixed) continue;
    const int parent = in.bodies.of_frame[joint.parent], child = in.bodies.of_frame[joint.child];
    joints_of[parent].push_back(j);
    joints_of[child].push_back(j);
  }
  std::vector<bool> walked(in.structure.joints.size());
  std::vector<int> step_of_body(in.bodies.count, kNone);
  std::vector<bool> reached(in.bodies.count);
  struct Level {
    int body, step;
    std::size_t next = 0;
  };
  std::vector<Level> levels = {{tree.root_body, kNone}};
  reached[tree.root_body] = true;
  while (!levels.empty()) {
    Level& level = levels.back();
    if (level.next == joints_of[level.body].size()) {
      levels.pop_back();
      continue;
    }
    const int j = joints_of[level.body][level.next++];
    if (walked[j]) continue;
    walked[j] = true;
    const Structure::Joint& joint = in.structure.joints[j];
    const bool from_parent = in.bodies.of_frame[joint.parent] == level.body;
    SpanningTree::Step step;
    step.joint = j;
    step.near = from_parent ? joint.parent : joint.child;
    step.far = from_parent ? joint.child : joint.parent;
    step.against = joint.directed && !from_parent;
    step.predecessor = level.step;
    if (!joint.directed) {
      in.warning(joint.iri,
                 fmt::format("the model does not say which attachment the position is of; "
                             "<{}>, the one further from the base, is taken",
                             in.text(in.structure.frames[step.far].iri)),
                 "state its origin-offset");
    }
    const int body = in.bodies.of_frame[step.far];
    if (reached[body]) {
      report_loop(in, tree, j, step_of_body);
      continue;
    }
    reached[body] = true;
    const int index = static_cast<int>(tree.steps.size());
    step_of_body[body] = index;
    tree.steps.push_back(step);
    levels.push_back({body, index});
  }
}

// Keeps the steps on the way to the tips.
void prune(const Search& in, const std::vector<std::string>& tips, SpanningTree& tree) {
  if (tips.empty()) return;
  std::vector<bool> keep(tree.steps.size());
  for (const std::string& tip : tips) {
    const Id element = resolve(
        in, tip, "tip",
        {iris_of(in.structure.links), iris_of(in.structure.joints), iris_of(in.structure.frames)});
    if (!element) continue;
    int body = kNone;
    if (const int link = in.structure.find_link(element); link != kNone) {
      body = in.bodies.of_link[link];
    } else if (const int frame = in.structure.find_frame(element); frame != kNone) {
      body = in.bodies.of_frame[frame];
    }
    int step = kNone;
    for (int s = 0; s < static_cast<int>(tree.steps.size()); ++s) {
      const bool leads = in.bodies.of_frame[tree.steps[s].far] == body;
      if (leads || in.structure.joints[tree.steps[s].joint].iri == element) step = s;
    }
    if (step == kNone && body != tree.root_body) {
      in.error(element,
               fmt::format("no joints lead from the base <{}> to the tip <{}>",
                           in.text(in.structure.links[tree.root_link].iri), in.text(element)),
               "name a base and a tip of one robot");
    }
    for (; step != kNone; step = tree.steps[step].predecessor) keep[step] = true;
  }
  std::vector<int> number(tree.steps.size(), kNone);
  std::vector<SpanningTree::Step> kept;
  for (std::size_t s = 0; s < tree.steps.size(); ++s) {
    if (!keep[s]) continue;
    number[s] = static_cast<int>(kept.size());
    kept.push_back(tree.steps[s]);
    int& predecessor = kept.back().predecessor;
    if (predecessor != kNone) predecessor = number[predecessor];
  }
  tree.steps = std::move(kept);
}

}  // namespace

int root_frame_of(const Structure& structure, int link, bool* guessed) {
  const std::vector<int>& frames = structure.links[link].frames;
  if (guessed) *guessed = false;
  if (frames.empty()) return kNone;
  const auto here = [&](int frame) { return structure.frames[frame].link == link; };
  for (const Structure::Joint& joint : structure.joints) {
    if (joint.directed && here(joint.child)) return joint.child;
  }
  std::vector<int> placed;
  bool any = false;
  for (const Structure::ConstantPose& pose : structure.poses) {
    if (!here(pose.of) || !here(pose.with_respect_to)) continue;
    placed.push_back(pose.of);
    any = true;
  }
  const auto is_placed = [&](int frame) {
    return std::find(placed.begin(), placed.end(), frame) != placed.end();
  };
  const auto unplaced = std::find_if_not(frames.begin(), frames.end(), is_placed);
  if (guessed) {
    *guessed = frames.size() > 1 &&
               (unplaced == frames.end() ||
                std::find_if_not(unplaced + 1, frames.end(), is_placed) != frames.end());
  }
  if (any && unplaced != frames.end()) return *unplaced;
  for (const Structure::Inertia& inertia : structure.inertias) {
    if (here(inertia.seen_by)) return inertia.seen_by;
  }
  return frames.front();
}

SpanningTree find_spanning_tree(const Structure& structure, const RigidBodies& bodies,
                                const graph::Terms& terms, const graph::Places& places,
                                const std::string& base, const std::vector<std::string>& tips,
                                Report& report) {
  const Search in{structure, bodies, terms, places, report};
  SpanningTree tree;
  check_that_joints_move(in);
  if (report.has_errors() || !choose_root(in, base, tree)) return tree;
  walk(in, tree);
  prune(in, tips, tree);
  return tree;
}

}  // namespace sinew::model
