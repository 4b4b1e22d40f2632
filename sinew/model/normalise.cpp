#include "sinew/model/normalise.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "sinew/model/choose_frames.h"
#include "sinew/model/coarse_snap.h"
#include "sinew/model/compound.h"
#include "sinew/model/couple.h"
#include "sinew/model/inertia.h"
#include "sinew/model/plausible.h"
#include "sinew/model/points.h"
#include "sinew/model/rigid_bodies.h"
#include "sinew/model/rotation.h"
#include "sinew/model/sizes.h"
#include "sinew/model/spanning_tree.h"
#include "sinew/model/structure.h"

namespace sinew::model {
namespace {

// What the stages of one normalisation share.
struct Work {
  graph::Store& store;
  const graph::Places& places;
  const NormaliseOptions& options;
  Report& report;

  Structure structure;
  RigidBodies bodies;
  SpanningTree walk;

  std::vector<int> tree_body;              // of each rigid body; kNone: not in the tree
  std::vector<std::optional<Pose>> poses;  // of each frame, in the frame of its body
  Tree tree;

  std::string_view text(Id id) const { return store.terms().text(id); }
  void error(Id node, std::string what, std::string remedy) {
    report.error(places.find(node), std::string(text(node)), std::move(what), std::move(remedy));
  }
  void warning(Id node, std::string what, std::string remedy) {
    report.warning(places.find(node), std::string(text(node)), std::move(what), std::move(remedy));
  }
};

void add_body(Work& work, int rigid_body, int first_frame, const Pose& pose) {
  work.tree_body[rigid_body] = static_cast<int>(work.tree.bodies.size());
  Tree::Body body;
  const int first = first_frame == work.walk.root_frame ? work.walk.root_link
                                                        : work.structure.frames[first_frame].link;
  if (first != kNone) body.links.push_back(work.structure.links[first].iri);
  for (const int link : work.bodies.links[rigid_body]) {
    if (link != first) body.links.push_back(work.structure.links[link].iri);
  }
  body.iri = body.links.empty() ? work.structure.frames[first_frame].iri : body.links.front();
  work.tree.bodies.push_back(std::move(body));
  place_frames(work.structure, work.bodies, work.store.terms(), work.places, first_frame, pose,
               work.poses, work.report);
}

// A turn or a slide.
void add_joint(Work& work, const SpanningTree::Step& step, const Structure::Joint& facts) {
  // The child's frame is the parent's moved by the offset; the joint's is the parent's, turned.
  const Vector3 z = step.against ? -facts.axis : facts.axis;
  const Pose in_parent = {rotation_with_z(z), {0, 0, 0}};
  const Pose in_child = {in_parent.R, -facts.offset * facts.axis};
  const bool far_is_child = step.far == facts.child;
  const Pose& in_near = far_is_child || !facts.directed ? in_parent : in_child;
  const Pose& in_far = far_is_child || !facts.directed ? in_child : in_parent;

  Tree::Joint joint;
  joint.iri = facts.iri;
  joint.kind = facts.kind;
  joint.predecessor = work.tree_body[work.bodies.of_frame[step.near]];
  joint.successor = static_cast<std::uint32_t>(work.tree.bodies.size());
  joint.placement = math::compose(*work.poses[step.near], in_near);
  joint.against_its_direction = step.against;
  joint.limits = facts.limits;
  joint.rotor_inertia = facts.rotor_inertia;
  work.tree.joints.push_back(joint);
  add_body(work, work.bodies.of_frame[step.far], step.far, math::invert(in_far));
}

// A joint of several motions: a joint of the tree for each, and bodies without mass between them.
void add_compound(Work& work, const SpanningTree::Step& step, const Structure::Joint& facts) {
  if (step.against && !commutes(facts.kind)) {
    work.error(facts.iri, "a joint of several axes is walked from its child to its parent",
               "name a base on its parent's side");
  }
  std::vector<CompoundPart> parts = parts_of(facts, step.against);
  graph::Terms& terms = work.store.terms();
  const Id role_part = terms.iri(vocab::tree::parts), role_body = terms.iri(vocab::tree::Body);
  Tree::Compound compound{facts.iri, facts.kind, {}};
  std::uint32_t predecessor = work.tree_body[work.bodies.of_frame[step.near]];
  const auto first = static_cast<int>(work.tree.joints.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    Tree::Joint joint;
    joint.iri = parts[k].iri
                    ? parts[k].iri
                    : terms.derived(role_part, {facts.iri, terms.integer(static_cast<int>(k))});
    joint.kind = parts[k].kind;
    joint.predecessor = predecessor;
    joint.successor = predecessor = static_cast<std::uint32_t>(work.tree.bodies.size());
    joint.placement =
        k == 0 ? math::compose(*work.poses[step.near], parts[k].placement) : parts[k].placement;
    joint.against_its_direction = step.against;
    joint.limits = parts[k].limits;
    joint.compound = static_cast<int>(work.tree.compounds.size());
    if (parts[k].follows) {
      joint.follows = first;
      joint.ratio = parts[k].ratio;
    } else {
      joint.rotor_inertia = facts.rotor_inertia;
    }
    compound.parts.push_back(static_cast<std::uint32_t>(work.tree.joints.size()));
    work.tree.joints.push_back(joint);
    if (k + 1 == parts.size()) break;
    Tree::Body between;
    between.iri = terms.derived(role_body, {joint.iri});
    work.tree.bodies.push_back(between);
  }
  work.tree.compounds.push_back(std::move(compound));
  add_body(work, work.bodies.of_frame[step.far], step.far, math::invert(parts.back().in_far));
}

// Bodies and joints, each body's frame where the joint puts it: on the far attachment, z on the
// axis.
void make_bodies_and_joints(Work& work) {
  const Structure& structure = work.structure;
  work.tree_body.assign(work.bodies.count, kNone);
  work.poses.assign(structure.frames.size(), std::nullopt);
  add_body(work, work.walk.root_body, work.walk.root_frame, identity_pose());
  for (const SpanningTree::Step& step : work.walk.steps) {
    const Structure::Joint& facts = structure.joints[step.joint];
    if (!work.poses[step.near]) {
      work.error(
          structure.frames[step.near].iri,
          fmt::format("no pose places this attachment of <{}> in its link", work.text(facts.iri)),
          "state a PoseCoordinate of it with respect to the link's root frame");
      work.poses[step.near] = identity_pose();
    }
    if (facts.motions.empty()) {
      add_joint(work, step, facts);
    } else {
      add_compound(work, step, facts);
    }
  }
}

void make_frames_and_links(Work& work) {
  const Structure& structure = work.structure;
  for (std::size_t f = 0; f < structure.frames.size(); ++f) {
    const int body = work.tree_body[work.bodies.of_frame[f]];
    if (body == kNone) continue;
    if (work.poses[f]) {
      work.tree.frames.push_back(
          {structure.frames[f].iri, static_cast<std::uint32_t>(body), *work.poses[f]});
    } else {
      work.warning(structure.frames[f].iri, "no pose places this frame in its body; it is left out",
                   "state a PoseCoordinate of it with respect to another frame of the link");
    }
  }
  for (std::size_t l = 0; l < structure.links.size(); ++l) {
    const int body = work.tree_body[work.bodies.of_link[l]];
    if (body == kNone) {
      if (work.options.tips.empty()) {
        work.tree.notes.push_back(fmt::format("<{}> is not connected to the base and left out",
                                              work.text(structure.links[l].iri)));
      }
      continue;
    }
    const int frame = root_frame_of(structure, static_cast<int>(l));
    work.tree.links.push_back({structure.links[l].iri, static_cast<std::uint32_t>(body),
                               frame == kNone ? Id{} : structure.frames[frame].iri});
  }
}

// Where a point of a body is, seen from the body's frame.
std::optional<Vector3> find_point(const Points& points, Id point, int rigid_body) {
  const auto found = points.find({rigid_body, point});
  if (found == points.end()) return std::nullopt;
  return found->second;
}

void add_inertias(Work& work, const Points& points) {
  std::vector<Id> inertia_of(work.structure.links.size());
  for (const Structure::Inertia& inertia : work.structure.inertias) {
    const int rigid_body = work.bodies.of_frame[inertia.seen_by];
    const int link = work.structure.find_link(inertia.link);
    if (link == kNone) {
      work.error(inertia.coordinate, "the inertia is of nothing that is a link",
                 "let it be of-body a link (SimplicialComplex)");
      continue;
    }
    if (work.bodies.of_link[link] != rigid_body) {
      work.error(inertia.coordinate,
                 fmt::format("the inertia is of <{}>, but seen from a frame of another body",
                             work.text(inertia.link)),
                 "see it from a frame of the link");
      continue;
    }
    if (inertia_of[link]) {
      work.error(inertia.coordinate,
                 fmt::format("<{}> has an inertia already, <{}>", work.text(inertia.link),
                             work.text(inertia_of[link])),
                 "state one inertia for each link");
      continue;
    }
    inertia_of[link] = inertia.coordinate;
    const int index = work.tree_body[rigid_body];
    if (index == kNone) continue;
    const auto p = find_point(points, inertia.about, rigid_body);
    if (!p || !work.poses[inertia.seen_by]) {
      work.error(
          inertia.coordinate,
          fmt::format("where <{}>, the point of the inertia, is in the link is not stated",
                      work.text(inertia.about)),
          "state a PositionCoordinate of it with respect to the origin of a frame of the link");
      continue;
    }
    Tree::Body& body = work.tree.bodies[index];
    const auto I = transformed(inertia.value, work.poses[inertia.seen_by]->R, *p);
    if (const std::string what = fault_of_size(I); !what.empty()) {
      work.error(inertia.coordinate, "about the joint, " + what, "check the number and its unit");
      continue;
    }
    body.inertia = body.has_inertia ? body.inertia + I : I;
    body.has_inertia = true;
  }
  std::string massless;
  for (std::size_t b = 1; b < work.tree.bodies.size(); ++b) {
    const Tree::Body& body = work.tree.bodies[b];
    if (body.links.empty() || (body.has_inertia && body.inertia.mass > 0)) continue;
    massless += fmt::format("{}<{}>", massless.empty() ? "" : ", ", work.text(body.iri));
  }
  if (!massless.empty()) work.tree.notes.push_back("bodies without mass: " + massless);
}

void add_gravity(Work& work, const Points& points) {
  Tree& tree = work.tree;
  if (work.options.gravity) {
    if (!within(*work.options.gravity, kLargestAcceleration))
      work.report.error({}, "",
                        fmt::format("the gravity is beyond {:g} m/s^2", kLargestAcceleration),
                        "give the gravity vector in m/s^2, for example 0,0,-9.81");
    tree.base_acceleration = {{0, 0, 0}, -*work.options.gravity};
    return;
  }
  const Structure::BaseAcceleration* used = nullptr;
  for (const Structure::BaseAcceleration& stated : work.structure.base_accelerations) {
    const int link = work.structure.find_link(stated.of);
    const int body = link == kNone ? kNone : work.bodies.of_link[link];
    if (body != work.walk.root_body || !work.poses[stated.seen_by]) {
      tree.notes.push_back(fmt::format(
          "the acceleration of <{}> is not that of the base and unused", work.text(stated.of)));
      continue;
    }
    if (used) {
      work.error(
          stated.coordinate,
          fmt::format("the base has an acceleration already, <{}>", work.text(used->coordinate)),
          "state the base's acceleration once, or give the gravity");
      continue;
    }
    const auto p = find_point(points, stated.reference_point, body);
    if (!p) {
      work.error(stated.coordinate,
                 "the reference point is no point of the base whose place is known",
                 "use the origin of the base's frame");
      continue;
    }
    used = &stated;
    const Matrix3& R = work.poses[stated.seen_by]->R;
    const Vector3 alpha = R * stated.value.angular;
    // At rest, the acceleration of the origin is a_P + alpha x (O - P).
    tree.base_acceleration = {alpha, R * stated.value.linear - cross(alpha, *p)};
  }
  if (!used && !work.options.gravity_varies) {
    tree.notes.emplace_back(
        "no gravity: the model states no acceleration of its base and none was given, so it is "
        "zero");
  }
}

// A body frame and a joint frame that coincide with a frame of the model are that frame.
void name_frames(Work& work) {
  Tree& tree = work.tree;
  graph::Terms& terms = work.store.terms();
  const Id role_body = terms.iri(vocab::tree::frame),
           role_joint = terms.iri(vocab::tree::joint_frame);
  std::vector<Id> named(tree.bodies.size());
  named[0] = work.structure.frames[work.walk.root_frame].iri;
  for (const Tree::Frame& frame : tree.frames) {
    if (!named[frame.body] && is_identity(frame.placement)) named[frame.body] = frame.iri;
  }
  for (const Tree::Link& link : tree.links) {
    const Tree::Frame* frame = link.root_frame ? tree.find_frame(link.root_frame) : nullptr;
    if (frame && link.body != 0 && is_identity(frame->placement) &&
        link.iri == tree.bodies[link.body].iri) {
      named[link.body] = link.root_frame;
    }
  }
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    tree.bodies[b].frame = named[b] ? named[b] : terms.derived(role_body, {tree.bodies[b].iri});
  }
  for (Tree::Joint& joint : tree.joints) {
    joint.joint_frame = terms.derived(role_joint, {joint.iri});
  }
}

}  // namespace

Tree normalise(graph::Store& store, const graph::Places& places, const NormaliseOptions& options,
               Report& report) {
  Work work{store, places, options, report, {}, {}, {}, {}, {}, {}};
  work.structure = read_structure(store, places, report);
  work.tree.notes = work.structure.notes;
  check_sizes(work.structure, store.terms(), places, report);
  check_inertias(work.structure, store.terms(), places, options.lenient, report);
  check_limits(work.structure, store.terms(), places, report);
  work.bodies = find_rigid_bodies(work.structure);
  if (report.has_errors()) return {};
  work.walk = find_spanning_tree(work.structure, work.bodies, store.terms(), places, options.base,
                                 options.tips, report);
  if (report.has_errors()) return {};
  make_bodies_and_joints(work);
  couple(work.structure, store.terms(), places, work.tree, report);
  make_frames_and_links(work);
  const Points points =
      place_points(work.structure, work.bodies, work.poses, store.terms(), places, report);
  add_inertias(work, points);
  add_gravity(work, points);
  if (report.has_errors()) return {};
  // Round-off first: it is not worth a word.
  const double round_off = std::min(options.snap_tolerance, kSnapTolerance);
  const double length = std::min(1.0, longest_length(work.tree));
  const double short_length =
      std::min(options.snap_tolerance, kLengthTolerance) * (length > 0 ? length : 1);
  snap(work.tree, round_off, short_length);
  if (options.snap_tolerance > kSnapTolerance) {
    std::ranges::move(snap_coarsely(work.tree, options.snap_tolerance, store.terms()),
                      std::back_inserter(work.tree.notes));
  }
  if (options.choose_frames) {
    choose_frames(work.tree, round_off);
    snap(work.tree, round_off, short_length);
  }
  name_frames(work);
  return std::move(work.tree);
}

}  // namespace sinew::model
