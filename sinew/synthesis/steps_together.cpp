#include "sinew/synthesis/steps_together.h"

#include <algorithm>
#include <functional>
#include <unordered_set>

#include "sinew/synthesis/block_specs.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/motion.h"
#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

// ---- a force as the sum of two ----

struct Sum {
  std::string whole, one, other;
};

void configure_sum(const Sum& sum, Context& context, const Visit& visit) {
  context.make(JointEdge(context, visit).coordinate(sum.whole, "force"));
}

void compute_sum(const Sum& sum, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  context.closure(edge.floats() ? "add-floating-force" : "add-joint-force",
                  {context.block(sum.one, edge.joint), context.block(sum.other, edge.joint),
                   context.block(sum.whole, edge.joint)},
                  edge.joint);
}

Step sum_step(std::string name, std::string purpose, const Sum& sum) {
  return {.name = std::move(name),
          .purpose = std::move(purpose),
          .direction = Direction::kLocal,
          .expansion = std::string(kAcrossJoints),
          .needs = {sum.one, sum.other},
          .may_use = {},
          .gives = {sum.whole},
          .visitors = {{Where::kEdge,
                        {},
                        {},
                        std::bind_front(configure_sum, sum),
                        std::bind_front(compute_sum, sum)}}};
}

// All that leads to the joints' forces of one motion.
void add_chain(std::vector<Step>& steps, Motion motion) {
  if (is_driven(motion)) steps.push_back(joint_acceleration_step(motion));
  steps.push_back(acceleration_step(motion));
  steps.push_back(own_wrench_step(motion));
  steps.push_back(wrench_step(motion));
  steps.push_back(joint_force_step(motion));
}

// ---- gravity seen from each body ----

// Along an axis of the root it is a multiple of a row of the body's rotation: no rotation is left
// to do.
void configure_gravity_root(Context& context, const Visit& visit) {
  context.board.put(slot_of(Motion::kRest, "body-acceleration"), visit.node,
                    context.block("base-acceleration", visit.node));
}

void configure_gravity(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto acceleration = [&](std::string_view slot, Id represents, Id of, Id wrt) {
    return at_frame(slot, "acceleration-twist", represents, of, edge.child, wrt);
  };
  const Id root = context.robot.root_body;
  context.make(acceleration("gravity-acceleration-of-root", edge.child, root, context.reference));
  context.make(zero(acceleration("no-acceleration-from-root", edge.child, edge.successor, root)));
  const std::string slot = slot_of(Motion::kRest, "body-acceleration");
  context.make(acceleration(slot, edge.child, edge.successor, context.reference));
}

void compute_gravity(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const BlockIndex of_root = context.block("gravity-acceleration-of-root", edge.child);
  context.closure("transform-acceleration-twist-to-distal-at-rest",
                  {context.block("pose", edge.child),
                   context.block("base-acceleration", context.robot.root_frame), of_root},
                  edge.joint);
  context.closure("add-acceleration-twist",
                  {of_root, context.block("no-acceleration-from-root", edge.child),
                   context.block(slot_of(Motion::kRest, "body-acceleration"), edge.child)},
                  edge.child);
}

Step gravity_by_poses_step() {
  return {.name = "gravity-by-poses",
          .purpose =
              "gravity is along an axis of the base: each body, whose pose is asked for "
              "too, sees it as a row of its rotation",
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"pose", "base-acceleration"},
          .may_use = {},
          .gives = {slot_of(Motion::kRest, "body-acceleration")},
          .visitors = {{Where::kNode,
                        {std::string(kIsRoot)},
                        std::string(kBodyOfNode),
                        configure_gravity_root,
                        {}},
                       {Where::kEdge, {}, {}, configure_gravity, compute_gravity}}};
}

// ---- what pays ----

bool along_an_axis(const std::array<double, 3>& gravity) {
  return std::count(gravity.begin(), gravity.end(), 0.0) == 2;
}

bool is_from_base(const Wanted& wanted) {
  return wanted.quantity->element == Element::kFrame && wanted.frames.size() == 1;
}

// Whether the poses of all bodies are computed anyway, on the way to those of frames.
bool all_poses(const graph::View& view, const Robot& robot, const Resolved& resolved) {
  std::unordered_set<std::size_t> passed;
  for (const Wanted& wanted : resolved.wanted)
    if (is_from_base(wanted))
      for (const std::size_t joint : path_to(robot, view, wanted.element)) passed.insert(joint);
  return passed.size() == robot.joints.size();
}

// Whether every twist that is asked for has a Jacobian that is, too, and joints have velocities of
// one number.
bool twists_have_jacobians(const Robot& robot, const Query& query, const Resolved& resolved) {
  const auto asked = [&](std::string_view quantity, Id frame) {
    return std::any_of(resolved.wanted.begin(), resolved.wanted.end(), [&](const Wanted& one) {
      return is_from_base(one) && one.element == frame && one.quantity->name == quantity;
    });
  };
  const bool free = std::any_of(robot.compounds.begin(), robot.compounds.end(),
                                [](const RobotCompound& one) { return one.is_free(); });
  return !query.floating && !free && resolved.wants("twist") &&
         std::all_of(resolved.wanted.begin(), resolved.wanted.end(), [&](const Wanted& one) {
           return one.quantity->name != "twist" || !is_from_base(one) ||
                  asked("jacobian", one.element);
         });
}

}  // namespace

std::vector<Step> steps_together(const graph::View& view, const Robot& robot, const Query& query,
                                 const Resolved& resolved, const Circumstances& circumstances) {
  std::vector<Step> steps;
  if (twists_have_jacobians(robot, query, resolved)) steps.push_back(frame_twist_step(true));
  if (circumstances.has_task) return steps;
  const bool bias = resolved.wants("bias-force"), gravity = resolved.wants("gravity-force");
  // Something else that needs the sum of all accelerations, or the wrenches kept apart.
  const bool whole = resolved.wants("joint-wrench") || resolved.wants("acceleration-twist") ||
                     (query.forces == Forces::kApart && resolved.wants("joint-force-share"));
  if (bias && resolved.wants("joint-force") && !whole) {
    add_chain(steps, Motion::kDriven);
    steps.push_back(sum_step("joint-force-by-parts",
                             "bias forces are asked for too; what joint accelerations take is "
                             "added to them",
                             {"force", "bias-force", "driven-force"}));
  }
  if (gravity && circumstances.gravity_is_constant && along_an_axis(circumstances.gravity) &&
      all_poses(view, robot, resolved)) {
    steps.push_back(gravity_by_poses_step());
    if (bias) {
      add_chain(steps, Motion::kVelocity);
      steps.push_back(sum_step("bias-force-by-parts",
                               "forces of gravity are asked for too; those of velocities are "
                               "added to them",
                               {"bias-force", "gravity-force", "velocity-force"}));
    }
  }
  return steps;
}

}  // namespace sinew::synthesis
