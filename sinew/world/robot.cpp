#include "sinew/world/robot.h"

#include <unordered_map>

#include "sinew/world/edit.h"

namespace sinew::world {

RobotInWorld add_robot(World& world, const model::Tree& tree, const graph::Terms& terms,
                       const RobotSpec& spec) {
  Edit edit = world.edit();
  std::unordered_map<graph::Id, FrameId> frames;
  const auto frame = [&](graph::Id iri) {
    const auto found = frames.find(iri);
    if (found != frames.end()) return found->second;
    const FrameId there = edit.find_frame(terms.text(iri));
    return frames[iri] = there ? there : edit.add_frame(terms.text(iri));
  };
  RobotInWorld robot;
  std::vector<FrameId> of_body;
  for (const model::Tree::Body& body : tree.bodies) of_body.push_back(frame(body.frame));
  robot.root = of_body.front();
  for (const model::Tree::Frame& fixed : tree.frames) {
    const FrameId body = of_body[fixed.body];
    const FrameId it = frame(fixed.iri);
    if (it == body) continue;
    edit.add_static(std::string(terms.text(fixed.iri)) + "/placement", it, body,
                    from_matrix(fixed.placement), spec.provenance);
  }
  for (const model::Tree::Joint& joint : tree.joints) {
    const std::string iri(terms.text(joint.iri));
    const RelationId relation = edit.add_relation(
        {.name = iri,
         .of = of_body[joint.successor],
         .with_respect_to = of_body[joint.predecessor],
         .kind = joint.kind == model::JointKind::kPrismatic ? RelationKind::kPrismatic
                                                            : RelationKind::kRevolute,
         .placement = from_matrix(joint.placement)});
    robot.joints.push_back(relation);
    const auto measurement = [&](const char* what, Quantity quantity) {
      return edit.add_measurement({.name = iri + "/" + what,
                                   .relation = relation,
                                   .quantity = quantity,
                                   .model = {.life_cycle = spec.life_cycle,
                                             .provenance = spec.provenance,
                                             .period = spec.period},
                                   .capacity = spec.capacity});
    };
    robot.positions.push_back(measurement("position", Quantity::kJointPosition));
    if (spec.velocities) {
      robot.velocities.push_back(measurement("velocity", Quantity::kJointVelocity));
    }
    if (spec.accelerations) {
      robot.accelerations.push_back(measurement("acceleration", Quantity::kJointAcceleration));
    }
  }
  edit.commit();
  return robot;
}

}  // namespace sinew::world
