#include "sinew/synthesis/regroup.h"

#include <algorithm>

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

void regroup(const Context& context, Inertias& inertias) {
  const auto& joints = context.robot.joints;
  for (auto joint = joints.rbegin(); joint != joints.rend(); ++joint) {
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
