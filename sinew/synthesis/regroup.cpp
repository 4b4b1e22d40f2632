#include "sinew/synthesis/regroup.h"

#include <algorithm>
#include <cmath>

#include "sinew/math/inertia.h"
#include "sinew/math/layout.h"
#include "sinew/synthesis/free_joint.h"

namespace sinew::synthesis {
namespace {

using Inertia = math::RigidBodyInertia<double>;
using InertiaLayout = math::Layout<Inertia>;

Id tree(const Context& context, std::string_view word) {
  return context.view.terms().find_iri(std::string(algorithm::kTreeNamespace) + std::string(word));
}

math::Pose<double> placement(const Context& context, Id joint) {
  const std::vector<double> numbers =
      context.numbers(context.view.object(joint, tree(context, "placement")));
  return math::Layout<math::Pose<double>>::load(numbers.data());
}

// What of a body's inertia the joint cannot tell from the predecessor's.
Inertia indifferent_part(const Inertia& inertia, std::string_view kind) {
  if (kind == "revolute") {
    // A rod's moment of inertia is its second moment along z; without it the second moments of the
    // body, which the Newton-Euler equations are computed with, lose one of their six.
    const math::Symmetric3<double>& I = inertia.rotational;
    const double a = 0.5 * (I.xx + I.yy - I.zz);
    return {inertia.mass, {0, 0, inertia.first_moment.z}, {a, 0, 0, a, 0, 0}};
  }
  if (kind == "prismatic") return {0, {0, 0, 0}, inertia.rotational};
  return {};
}

Inertia minus(const Inertia& a) {
  const math::Symmetric3<double>& I = a.rotational;
  return {-a.mass, -a.first_moment, {-I.xx, -I.xy, -I.xz, -I.yy, -I.yz, -I.zz}};
}

void add(Inertias& inertias, Id body, const Inertia& inertia) {
  std::array<double, 10>& numbers = inertias[body];
  InertiaLayout::store(math::add(InertiaLayout::load(numbers.data()), inertia), numbers.data());
}

}  // namespace

Inertias stated_inertias(const Context& context) {
  Inertias inertias;
  const Id property = tree(context, "inertia");
  if (!property) return inertias;
  const auto note = [&](Id body) {
    const Id coordinate = context.view.object(body, property);
    if (!coordinate) return;
    const std::vector<double> numbers = context.numbers(coordinate);
    std::copy_n(numbers.begin(), 10, inertias[body].begin());
  };
  note(context.robot.root_body);
  for (const RobotJoint& joint : context.robot.joints) note(joint.successor);
  return inertias;
}

namespace {

bool turns_by_itself(const Context& context, const RobotJoint& joint) {
  return joint.kind == "revolute" && free_part(context, joint.joint).whole == nullptr;
}

// The only joint behind a body, if there is one.
const RobotJoint* only_successor(const Context& context, Id body) {
  const RobotJoint* only = nullptr;
  for (const RobotJoint& one : context.robot.joints) {
    if (one.predecessor != body) continue;
    if (only != nullptr) return nullptr;
    only = &one;
  }
  return only;
}

// Takes so much mass from the successor, at a point of the axis between the two, that the body's
// first moment loses x or y.
void balance(const Context& context, const RobotJoint& joint, double most, Inertias& inertias) {
  const RobotJoint* next = only_successor(context, joint.successor);
  if (next == nullptr || !turns_by_itself(context, joint) || !turns_by_itself(context, *next) ||
      !inertias.contains(joint.successor) || !inertias.contains(next->successor)) {
    return;
  }
  const math::Pose<double> X = placement(context, next->joint);
  const bool along_x = std::abs(X.p.x) > std::abs(X.p.y);
  const double lever = along_x ? X.p.x : X.p.y;
  const std::size_t number = along_x ? 1 : 2;  // m hx hy ...
  const double moment = inertias.at(joint.successor)[number];
  if (moment == 0 || std::abs(moment) > most * std::abs(lever)) return;
  const Inertia moved = {-moment / lever, {0, 0, 0}, {0, 0, 0, 0, 0, 0}};
  add(inertias, next->successor, minus(moved));
  add(inertias, joint.successor, math::transform_to_proximal(X, moved));
  inertias.at(joint.successor)[number] = 0;
}

}  // namespace

void regroup(const Context& context, Inertias& inertias, Masses masses) {
  double all = 0;
  for (const auto& [body, numbers] : inertias) all += numbers[0];
  const auto& joints = context.robot.joints;
  for (auto joint = joints.rbegin(); joint != joints.rend(); ++joint) {
    if (masses == Masses::kBalanced) balance(context, *joint, all, inertias);
    const auto found = inertias.find(joint->successor);
    if (found == inertias.end() || free_part(context, joint->joint).whole != nullptr) continue;
    const Inertia moved = indifferent_part(InertiaLayout::load(found->second.data()), joint->kind);
    add(inertias, joint->successor, minus(moved));
    add(inertias, joint->predecessor,
        math::transform_to_proximal(placement(context, joint->joint), moved));
  }
  inertias.erase(context.robot.root_body);
}

}  // namespace sinew::synthesis
