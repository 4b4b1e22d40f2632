#include "sinew/model/regroup.h"

#include <cmath>

#include "sinew/model/inertia.h"

namespace sinew::model {
namespace {

// Takes the part on the z axis out of an inertia.
RigidBodyInertia take_axial_part(RigidBodyInertia& I) {
  auto& J = I.rotational;
  const double second_moment = 0.5 * (J.xx + J.yy - J.zz);
  const RigidBodyInertia part = {
      I.mass, {0, 0, I.first_moment.z}, {second_moment, 0, 0, second_moment, 0, 0}};
  I.mass = 0;
  I.first_moment.z = 0;
  J.xx -= second_moment;
  // What is left has no second moment along z, Ixx + Iyy = Izz: exactly, so that products with
  // zero can be left out. Rounding is off by a few units in the last place at most.
  J.yy = J.zz - J.xx;
  for (int step = 0; step < 4 && J.xx + J.yy != J.zz; ++step) {
    J.yy = std::nextafter(J.yy, J.xx + J.yy < J.zz ? INFINITY : -INFINITY);
  }
  return part;
}

RigidBodyInertia take_rotational_part(RigidBodyInertia& I) {
  const RigidBodyInertia part = {0, {0, 0, 0}, I.rotational};
  I.rotational = {};
  return part;
}

}  // namespace

void regroup_inertial_parameters(Tree& tree) {
  for (std::size_t b = tree.bodies.size(); b-- > 1;) {
    Tree::Body& body = tree.bodies[b];
    if (!body.has_inertia) continue;
    const Tree::Joint& joint = tree.joints[b - 1];
    const RigidBodyInertia part = joint.kind == JointKind::kPrismatic
                                      ? take_rotational_part(body.inertia)
                                      : take_axial_part(body.inertia);
    Tree::Body& predecessor = tree.bodies[joint.predecessor];
    const RigidBodyInertia moved = transformed(part, joint.placement.R, joint.placement.p);
    predecessor.inertia = predecessor.has_inertia ? predecessor.inertia + moved : moved;
    predecessor.has_inertia = true;
  }
}

}  // namespace sinew::model
