#include "small_robot.h"

namespace sinew::synthesis {
namespace {

using model::Tree;

model::Pose translation(double x, double y, double z) {
  return {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {x, y, z}};
}

void add_body(graph::Store& store, Tree& tree, const std::string& name, double mass) {
  Tree::Body body;
  body.iri = example(store, name);
  body.frame = example(store, name + "-frame");
  body.links = {body.iri};
  body.has_inertia = mass > 0;
  body.inertia = {mass, {0.1 * mass, 0, 0.2 * mass}, {0.1, 0, 0, 0.2, 0, 0.3}};
  const auto index = static_cast<std::uint32_t>(tree.bodies.size());
  tree.frames.push_back({body.frame, index, translation(0, 0, 0)});
  tree.links.push_back({body.iri, index, body.frame});
  tree.bodies.push_back(std::move(body));
}

void add_joint(graph::Store& store, Tree& tree, const std::string& name, model::JointKind kind,
               std::uint32_t predecessor) {
  Tree::Joint joint;
  joint.iri = example(store, name);
  joint.kind = kind;
  joint.predecessor = predecessor;
  joint.successor = static_cast<std::uint32_t>(tree.joints.size() + 1);
  joint.joint_frame = example(store, name + "-joint-frame");
  joint.placement = translation(0.1, 0.2, 0.3);
  tree.joints.push_back(joint);
}

}  // namespace

void write_small_robot(graph::Store& store) {
  Tree tree;
  add_body(store, tree, "base", 0);
  for (const char* name : {"A", "B", "C", "D"}) add_body(store, tree, name, 1.5);
  add_joint(store, tree, "one", model::JointKind::kRevolute, 0);
  add_joint(store, tree, "two", model::JointKind::kRevolute, 1);
  add_joint(store, tree, "three", model::JointKind::kPrismatic, 2);
  add_joint(store, tree, "four", model::JointKind::kRevolute, 1);
  tree.frames.push_back({example(store, "tool"), 3, translation(0, 0, 0.5)});
  model::write(tree, store);
}

}  // namespace sinew::synthesis
