// The vocabulary that the model's passes use, interned once for each pass.
#pragma once

#include "sinew/graph/standard_iris.h"
#include "sinew/graph/terms.h"
#include "sinew/vocab/vocab.h"

namespace sinew::model {

class Ids {
 private:
  graph::Terms& terms_;
  graph::Id iri(std::string_view text) { return terms_.iri(text); }

 public:
  using Id = graph::Id;
  explicit Ids(graph::Terms& terms) : terms_(terms) {}

  Id type = iri(graph::kRdfType), first = iri(graph::kRdfFirst), rest = iri(graph::kRdfRest),
     nil = iri(graph::kRdfNil);
  Id unit = iri(vocab::qudt::unit);

  // Geometry: entities and relations.
  Id link = iri(vocab::geom::SimplicialComplex), simplices = iri(vocab::geom::simplices);
  Id frame = iri(vocab::geom::Frame), origin = iri(vocab::geom::origin);
  Id start = iri(vocab::geom::start);
  Id vector_x = iri(vocab::geom::vector_x), vector_y = iri(vocab::geom::vector_y),
     vector_z = iri(vocab::geom::vector_z);
  Id of = iri(vocab::geom_rel::of), with_respect_to = iri(vocab::geom_rel::with_respect_to);
  Id reference_point = iri(vocab::geom_rel::reference_point), lines = iri(vocab::geom_rel::lines);

  // Geometry: coordinates.
  Id pose_coordinate = iri(vocab::geom_coord::PoseCoordinate);
  Id position_coordinate = iri(vocab::geom_coord::PositionCoordinate);
  Id orientation_coordinate = iri(vocab::geom_coord::OrientationCoordinate);
  Id direction_coordinate = iri(vocab::geom_coord::DirectionCoordinate);
  Id velocity_twist_coordinate = iri(vocab::geom_coord::VelocityTwistCoordinate);
  Id acceleration_twist_coordinate = iri(vocab::geom_coord::AccelerationTwistCoordinate);
  Id of_pose = iri(vocab::geom_coord::of_pose), of_position = iri(vocab::geom_coord::of_position),
     of_orientation = iri(vocab::geom_coord::of_orientation),
     of_velocity = iri(vocab::geom_coord::of_velocity),
     of_acceleration = iri(vocab::geom_coord::of_acceleration),
     of_direction = iri(vocab::sg::of_direction);
  Id seen_by = iri(vocab::geom_coord::as_seen_by);
  Id cosine_x = iri(vocab::geom_coord::direction_cosine_x),
     cosine_y = iri(vocab::geom_coord::direction_cosine_y),
     cosine_z = iri(vocab::geom_coord::direction_cosine_z);
  Id x = iri(vocab::geom_coord::x), y = iri(vocab::geom_coord::y), z = iri(vocab::geom_coord::z);
  Id angular_velocity = iri(vocab::geom_coord::angular_velocity),
     linear_velocity = iri(vocab::geom_coord::linear_velocity),
     angular_acceleration = iri(vocab::geom_coord::angular_acceleration),
     linear_acceleration = iri(vocab::geom_coord::linear_acceleration);

  // Kinematic chain.
  Id joint = iri(vocab::kc::Joint), revolute = iri(vocab::kc::RevoluteJoint);
  Id fixed = iri(vocab::skc::FixedJoint), prismatic = iri(vocab::skc::PrismaticJoint);
  Id between_attachments = iri(vocab::kc::between_attachments),
     common_axis = iri(vocab::kc::common_axis), origin_offset = iri(vocab::kc::origin_offset);
  Id polarity = iri(vocab::kc::polarity), positive = iri(vocab::kc::PositivePolarity),
     negative = iri(vocab::skc::NegativePolarity);
  Id of_joint = iri(vocab::kc_stat::of_joint);
  Id position_limits = iri(vocab::skc::JointPositionLimits), lower = iri(vocab::skc::lower),
     upper = iri(vocab::skc::upper), maximum = iri(vocab::skc::maximum);
  Id velocity_limit = iri(vocab::skc::JointVelocityLimit),
     force_limit = iri(vocab::skc::JointForceLimit);
  Id mimicry = iri(vocab::skc::JointMimicry), mimics = iri(vocab::skc::mimics),
     multiplier = iri(vocab::skc::multiplier), mimic_offset = iri(vocab::skc::offset);
  Id helical = iri(vocab::skc::HelicalJoint), cylindrical = iri(vocab::skc::CylindricalJoint),
     planar = iri(vocab::skc::PlanarJoint), spherical = iri(vocab::skc::SphericalJoint),
     floating = iri(vocab::skc::FloatingJoint), universal = iri(vocab::skc::UniversalJoint),
     composite = iri(vocab::skc::CompositeJoint);
  Id sequence = iri(vocab::skc::sequence), revolute_motion = iri(vocab::skc::RevoluteMotion),
     prismatic_motion = iri(vocab::skc::PrismaticMotion);
  Id joint_pitch = iri(vocab::skc::JointPitch), pitch = iri(vocab::skc::pitch);
  Id transmission = iri(vocab::skc::JointTransmission), transmission_ratio = iri(vocab::skc::ratio),
     rotor_inertia = iri(vocab::skc::rotor_inertia);
  Id degree_of_freedom = iri(vocab::skc::degree_of_freedom);
  Id chain = iri(vocab::kc::KinematicChain), joints = iri(vocab::kc::joints);

  // Dynamics. The older age writes `of` for `of-body`, and the legacy metamodel puts all on one
  // node.
  Id inertia_coordinate = iri(vocab::dyn_coord::RigidBodyInertiaCoordinate),
     of_inertia = iri(vocab::dyn_coord::of_inertia),
     inertia_seen_by = iri(vocab::dyn_coord::as_seen_by);
  Id inertia = iri(vocab::dyn_ent::RigidBodyInertia), of_body = iri(vocab::dyn_ent::of_body),
     inertia_of = iri(vocab::dyn_ent::of), about = iri(vocab::dyn_ent::about);
  Id mass = iri(vocab::dyn_coord::mass), first_moment = iri(vocab::dyn_coord::first_moment_of_mass);
  Id mass_coordinate = iri(vocab::dyn_coord::MassCoordinate),
     rotational_inertia_coordinate = iri(vocab::dyn_coord::RotationalInertiaCoordinate);
  Id ixx = iri(vocab::dyn_coord::ixx), iyy = iri(vocab::dyn_coord::iyy),
     izz = iri(vocab::dyn_coord::izz), ixy = iri(vocab::dyn_coord::ixy),
     ixz = iri(vocab::dyn_coord::ixz), iyz = iri(vocab::dyn_coord::iyz);
  Id legacy_mass = iri(vocab::dyn_ent::mass), legacy_xx = iri(vocab::dyn_ent::xx),
     legacy_yy = iri(vocab::dyn_ent::yy), legacy_zz = iri(vocab::dyn_ent::zz);
};

}  // namespace sinew::model
