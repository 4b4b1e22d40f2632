#include "sinew/model/compound.h"

#include "sinew/math/rotation.h"
#include "sinew/model/rotation.h"

namespace sinew::model {
namespace {

// Turns x to y, y to z, z to x.
Matrix3 next_axis() { return {0, 0, 1, 1, 0, 0, 0, 1, 0}; }

}  // namespace

bool commutes(JointKind kind) {
  return kind == JointKind::kHelical || kind == JointKind::kCylindrical;
}

std::vector<CompoundPart> parts_of(const Structure::Joint& joint, bool against) {
  std::vector<CompoundPart> parts;
  const bool free = is_free(joint.kind);
  Pose before = identity_pose();  // z of the part before, at position zero
  for (const Structure::Motion& motion : joint.motions) {
    CompoundPart part;
    part.iri = motion.iri;
    part.kind = motion.kind;
    part.follows = motion.follows;
    part.ratio = motion.ratio;
    part.limits = motion.limits;
    Pose at = identity_pose();
    at.R = free ? before.R * next_axis() : rotation_with_z(against ? -motion.axis : motion.axis);
    part.placement = math::compose(math::invert(before), at);
    part.in_far = at;
    before = at;
    parts.push_back(part);
  }
  // The child's origin is moved along the axis: seen from it the parent's is behind, and the other
  // way round.
  const Vector3 offset = joint.offset * joint.axis;
  if (against && joint.directed) {
    parts.front().placement.p = parts.front().placement.p - offset;
  } else {
    parts.back().in_far.p = parts.back().in_far.p - offset;
  }
  return parts;
}

}  // namespace sinew::model
