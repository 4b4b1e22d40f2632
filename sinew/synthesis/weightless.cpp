#include "sinew/synthesis/weightless.h"

#include <algorithm>
#include <cmath>

#include "sinew/synthesis/asked.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/query_faults.h"
#include "sinew/synthesis/regroup.h"

namespace sinew::synthesis {
namespace {

// Beside the largest inertia of the body, what turns no axis more than round-off does.
constexpr double kRoundOff = 1e-14;

// (m, h, Ixx Ixy Ixz Iyy Iyz Izz) about the origin of the frame whose z is the joint's axis.
bool resists(const std::array<double, 10>& inertia, const std::string& kind) {
  if (kind != "revolute") return inertia[0] > 0;
  const double across = std::max(std::abs(inertia[4]), std::abs(inertia[7]));
  return inertia[9] > kRoundOff * across;
}

void check(Context& context, const Visit& visit) {
  const auto& joints = context.robot.joints;
  const auto joint = std::find_if(joints.begin(), joints.end(),
                                  [&](const RobotJoint& one) { return one.frame == visit.node; });
  if (joint == joints.end()) return;
  const auto behind = std::count_if(joints.begin(), joints.end(), [&](const RobotJoint& one) {
    return one.parent_frame == visit.node;
  });
  // With others that move along, it is no single joint that must have something to move.
  const int index = static_cast<int>(joint - joints.begin());
  const bool leads = std::any_of(joints.begin(), joints.end(),
                                 [&](const RobotJoint& one) { return one.follows == index; });
  if (joint->follows >= 0 || leads) return;
  const bool floats = joint->kind == "floating";
  if (behind > (floats ? 1 : 0) || joint->rotor_inertia > 0) return;
  // Regrouping may have moved mass onto a base, but none that is its own.
  const auto inertias = floats ? stated_inertias(context) : context.inertias;
  const auto inertia = inertias.find(visit["body"]);
  if (inertia != inertias.end() && resists(inertia->second, joint->kind)) return;
  const std::string what =
      floats ? "it floats, has no mass, and nothing holds it but one joint: its acceleration is "
               "not defined"
      : inertia == inertias.end()
          ? "it ends a chain and has no inertia: its joint's acceleration is not defined"
          : std::string("it ends a chain and has no inertia ") +
                (joint->kind == "revolute" ? "about" : "along") +
                " its joint's axis: its joint's acceleration is not defined";
  throw Error(Problem{{},
                      std::string(context.view.terms().text(visit["body"])),
                      what,
                      floats ? "state its mass and inertia, or let the base be fixed"
                             : "state its inertia, or make its joint a fixed one",
                      {},
                      {}});
}

}  // namespace

void check_there_is_mass(const Context& context, Report& report) {
  const Inertias inertias = stated_inertias(context);
  if (std::any_of(inertias.begin(), inertias.end(),
                  [](const auto& one) { return one.second[0] > 0; }))
    return;
  for (const Asked& asked : context.query.asked) {
    const AskedQuantity* row = find_asked(asked.quantity);
    // Mass matrices and forces of what has no mass are zero.
    if (row == nullptr || !row->dynamic || row->regroups || row->element != Element::kRobot)
      continue;
    report.add(fault_in(context.query, asked.origin, asked.quantity,
                        "it is asked, but nothing of the robot has mass", "state masses of links"));
  }
}

Visitor refuse_weightless() {
  return {Where::kNode, {std::string(kIsNotRoot)}, std::string(kBodyOfNode), check, {}};
}

}  // namespace sinew::synthesis
