#include "sinew/model/urdf.h"

#include <cmath>

#include "sinew/graph/standard_iris.h"
#include "sinew/model/rotation.h"
#include "sinew/model/urdf_document.h"
#include "sinew/vocab/vocab.h"

namespace sinew::model {
namespace {

using urdf::Document;
using urdf::Numbers3;
using urdf::Origin;

// A name as one segment of an IRI.
std::string encoded(std::string_view name) {
  static constexpr char kDigits[] = "0123456789ABCDEF";
  std::string text;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '.' || c == '_' || c == '~';
    if (plain) {
      text += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      text += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
    }
  }
  return text;
}

class Importer {
 public:
  Importer(const Document& document, std::string base, graph::Terms& terms,
           graph::Transaction& transaction, graph::Places& places)
      : document_(document),
        base_(std::move(base)),
        terms_(terms),
        transaction_(transaction),
        places_(places),
        file_(places.add_file(document.file)) {
    if (!base_.ends_with('/') && !base_.ends_with('#')) base_ += '/';
  }

  void run() {
    for (const urdf::Link& link : document_.links) write_link(link);
    if (document_.joints.empty()) return;  // one body, as a drone is: a chain has joints
    const Id chain = node("", "chain");
    in("chain");
    at(chain, document_.line);
    type(chain, {vocab::kc::KinematicChain});
    for (const urdf::Joint& joint : document_.joints) {
      in("chain");
      add(chain, vocab::kc::joints, node("joint", joint.name));
      write_joint(joint);
    }
  }

 private:
  using Id = graph::Id;

  Id iri(std::string_view text) { return terms_.iri(text); }
  Id node(std::string_view kind, std::string_view name) {
    return iri(base_ + std::string(kind) + (kind.empty() ? "" : "/") + encoded(name));
  }
  Id unit(std::string_view name) { return iri("http://qudt.org/vocab/unit/" + std::string(name)); }

  // The graph that the following statements go to: one for each concern.
  void in(std::string_view concern) { graph_ = iri(base_ + std::string(concern)); }
  void at(Id node, std::size_t line) {
    places_.note(node, {}, file_, static_cast<std::uint32_t>(line), 0);
  }
  void add(Id subject, std::string_view predicate, Id object) {
    transaction_.add({subject, iri(predicate), object, graph_});
  }
  void type(Id subject, std::initializer_list<std::string_view> types) {
    for (const std::string_view type : types) add(subject, graph::kRdfType, iri(type));
  }
  void units(Id subject, std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) add(subject, vocab::qudt::unit, unit(name));
  }
  void number(Id subject, std::string_view predicate, double value) {
    add(subject, predicate, terms_.real(value));
  }
  void list(Id subject, std::string_view predicate, std::initializer_list<double> values) {
    Id rest = iri(graph::kRdfNil);
    for (auto value = std::rbegin(values); value != std::rend(values); ++value) {
      const Id cell = terms_.fresh_blank();
      add(cell, graph::kRdfFirst, terms_.real(*value));
      add(cell, graph::kRdfRest, rest);
      rest = cell;
    }
    add(subject, predicate, rest);
  }
  void vector(Id subject, const Numbers3& v) {
    type(subject, {vocab::geom_coord::VectorXYZ});
    number(subject, vocab::geom_coord::x, v[0]);
    number(subject, vocab::geom_coord::y, v[1]);
    number(subject, vocab::geom_coord::z, v[2]);
  }
  // Position and orientation, both seen by a frame.
  void pose_numbers(Id subject, const Origin& origin, Id seen_by) {
    const Matrix3 R = rotation_from_rpy(origin.rpy[0], origin.rpy[1], origin.rpy[2]);
    type(subject, {vocab::geom_coord::DirectionCosineXYZ});
    add(subject, vocab::geom_coord::as_seen_by, seen_by);
    units(subject, {"UNITLESS", "M"});
    list(subject, vocab::geom_coord::direction_cosine_x, {R.xx, R.yx, R.zx});
    list(subject, vocab::geom_coord::direction_cosine_y, {R.xy, R.yy, R.zy});
    list(subject, vocab::geom_coord::direction_cosine_z, {R.xz, R.yz, R.zz});
    vector(subject, origin.xyz);
  }

  void point(Id subject, std::size_t line) {
    type(subject, {vocab::geom::n3D, vocab::geom::Euclidean, vocab::geom::Point});
    at(subject, line);
  }
  void frame(Id subject, Id origin, std::size_t line) {
    type(subject, {vocab::geom::n3D, vocab::geom::Frame, vocab::geom::Orthogonal,
                   vocab::geom::UnitLength, vocab::geom::RightHanded});
    add(subject, vocab::geom::origin, origin);
    at(subject, line);
  }
  void relation(Id subject, std::string_view kind, Id of, Id with_respect_to, std::size_t line) {
    type(subject, {kind});
    add(subject, vocab::geom_rel::of, of);
    add(subject, vocab::geom_rel::with_respect_to, with_respect_to);
    at(subject, line);
  }
  // A pose and its coordinates, KIND/NAME and KIND-coordinates/NAME.
  void pose(std::string_view kind, std::string_view name, Id of, Id with_respect_to,
            const Origin& origin, std::size_t line) {
    const Id relation_node = node(kind, name);
    const Id numbers = node(std::string(kind) + "-coordinates", name);
    relation(relation_node, vocab::geom_rel::Pose, of, with_respect_to, line);
    type(numbers, {vocab::geom_coord::PoseReference, vocab::geom_coord::PoseCoordinate});
    add(numbers, vocab::geom_coord::of_pose, relation_node);
    pose_numbers(numbers, origin, with_respect_to);
    at(numbers, line);
  }

  void write_link(const urdf::Link& link) {
    in("geometry");
    const Id body = node("link", link.name);
    const Id origin = node("origin", link.name);
    const Id own_frame = node("frame", link.name);
    type(body, {vocab::geom::SimplicialComplex, vocab::geom::RigidBody});
    at(body, link.line);
    add(body, vocab::geom::simplices, origin);
    add(body, vocab::geom::simplices, own_frame);
    point(origin, link.line);
    frame(own_frame, origin, link.line);
    if (link.inertial) write_inertial(link, *link.inertial, body, origin, own_frame);
    std::size_t count[2] = {};
    for (const urdf::Shape& shape : link.shapes) {
      write_shape(link, shape, count[shape.visual]++, body, own_frame);
    }
  }

  void write_inertial(const urdf::Link& link, const urdf::Inertial& inertial, Id body, Id origin,
                      Id own_frame) {
    const Id com = node("centre-of-mass", link.name);
    point(com, inertial.line);
    add(body, vocab::geom::simplices, com);
    Id seen_by = own_frame;
    if (inertial.origin.rpy == Numbers3{0, 0, 0}) {
      const Id position = node("centre-of-mass-position", link.name);
      const Id numbers = node("centre-of-mass-coordinates", link.name);
      relation(position, vocab::geom_rel::Position, com, origin, inertial.line);
      type(numbers, {vocab::geom_coord::PositionReference, vocab::geom_coord::PositionCoordinate});
      add(numbers, vocab::geom_coord::of_position, position);
      add(numbers, vocab::geom_coord::as_seen_by, own_frame);
      units(numbers, {"M"});
      vector(numbers, inertial.origin.xyz);
      at(numbers, inertial.line);
    } else {
      seen_by = node("inertial-frame", link.name);
      frame(seen_by, com, inertial.line);
      add(body, vocab::geom::simplices, seen_by);
      pose("inertial-pose", link.name, seen_by, own_frame, inertial.origin, inertial.line);
    }
    in("dynamics");
    const Id inertia = node("inertia", link.name);
    const Id numbers = node("inertia-coordinates", link.name);
    type(inertia, {vocab::dyn_ent::RigidBodyInertia});
    add(inertia, vocab::dyn_ent::of_body, body);
    add(inertia, vocab::dyn_ent::about, com);
    at(inertia, inertial.line);
    type(numbers, {vocab::dyn_coord::InertiaReference, vocab::dyn_coord::RigidBodyInertiaCoordinate,
                   vocab::dyn_coord::MassScalar, vocab::dyn_coord::FirstMomentOfMassVectorXYZ,
                   vocab::dyn_coord::MomentOfInertiaXYZ, vocab::dyn_coord::ProductOfInertiaXYZ});
    add(numbers, vocab::dyn_coord::of_inertia, inertia);
    add(numbers, vocab::dyn_coord::as_seen_by, seen_by);
    units(numbers, {"KiloGM", "M-KiloGM", "KiloGM-M2"});
    number(numbers, vocab::dyn_coord::mass, inertial.mass);
    list(numbers, vocab::dyn_coord::first_moment_of_mass, {0, 0, 0});
    number(numbers, vocab::dyn_coord::ixx, inertial.ixx);
    number(numbers, vocab::dyn_coord::ixy, inertial.ixy);
    number(numbers, vocab::dyn_coord::ixz, inertial.ixz);
    number(numbers, vocab::dyn_coord::iyy, inertial.iyy);
    number(numbers, vocab::dyn_coord::iyz, inertial.iyz);
    number(numbers, vocab::dyn_coord::izz, inertial.izz);
    at(numbers, inertial.line);
    in("geometry");
  }

  void write_shape(const urdf::Link& link, const urdf::Shape& shape, std::size_t index, Id body,
                   Id own_frame) {
    in("shapes");
    const Id subject = iri(base_ + (shape.visual ? "visual/" : "collision/") + encoded(link.name) +
                           "/" + std::to_string(index));
    type(subject, {shape.visual ? vocab::shape::Visual : vocab::shape::Collision});
    add(subject, vocab::shape::of_body, body);
    pose_numbers(subject, shape.origin, own_frame);
    if (const auto* box = std::get_if<urdf::Box>(&shape.geometry)) {
      type(subject, {vocab::shape::Box});
      list(subject, vocab::shape::size, {box->size[0], box->size[1], box->size[2]});
    } else if (const auto* cylinder = std::get_if<urdf::Cylinder>(&shape.geometry)) {
      type(subject, {vocab::shape::Cylinder});
      number(subject, vocab::shape::radius, cylinder->radius);
      number(subject, vocab::shape::length, cylinder->length);
    } else if (const auto* sphere = std::get_if<urdf::Sphere>(&shape.geometry)) {
      type(subject, {vocab::shape::Sphere});
      number(subject, vocab::shape::radius, sphere->radius);
    } else {
      const auto& mesh = std::get<urdf::Mesh>(shape.geometry);
      type(subject, {vocab::shape::Mesh});
      add(subject, vocab::shape::file, terms_.literal(mesh.file));
      list(subject, vocab::shape::scale, {mesh.scale[0], mesh.scale[1], mesh.scale[2]});
    }
    at(subject, shape.line);
    in("geometry");
  }

  void write_joint(const urdf::Joint& joint) {
    const Id subject = node("joint", joint.name);
    const Id parent_frame = node("joint-frame", joint.name);
    const Id parent_origin = node("joint-origin", joint.name);
    const Id child_frame = node("frame", joint.child);
    const Id child_origin = node("origin", joint.child);
    const Id offset = node("joint-offset", joint.name);

    in("geometry");
    const Id parent = node("link", joint.parent);
    add(parent, vocab::geom::simplices, parent_origin);
    add(parent, vocab::geom::simplices, parent_frame);
    point(parent_origin, joint.line);
    frame(parent_frame, parent_origin, joint.line);
    pose("joint-pose", joint.name, parent_frame, node("frame", joint.parent), joint.origin,
         joint.line);

    in("chain");
    type(subject, {vocab::kc::Joint});
    at(subject, joint.line);
    add(subject, vocab::kc::between_attachments, parent_frame);
    add(subject, vocab::kc::between_attachments, child_frame);
    add(subject, vocab::kc::origin_offset, offset);
    relation(offset, vocab::geom_rel::Position, child_origin, parent_origin, joint.line);
    switch (joint.type) {
      case urdf::JointType::kFixed:
        type(subject, {vocab::skc::FixedJoint});
        return;
      case urdf::JointType::kFloating:
        type(subject, {vocab::skc::FloatingJoint});
        return;
      case urdf::JointType::kPlanar:
        type(subject, {vocab::skc::PlanarJoint});
        write_axis(joint, subject, parent_frame, parent_origin, child_frame, child_origin);
        return;
      case urdf::JointType::kPrismatic:
        type(subject,
             {vocab::skc::PrismaticJoint, vocab::skc::PrismaticJointWithOrientedAxisOfTranslation});
        break;
      case urdf::JointType::kContinuous:
        type(subject, {vocab::skc::ContinuousJoint});
        [[fallthrough]];
      case urdf::JointType::kRevolute:
        type(subject,
             {vocab::kc::RevoluteJoint, vocab::kc::RevoluteJointWithOrientedAxisOfRotation});
        break;
    }
    write_axis(joint, subject, parent_frame, parent_origin, child_frame, child_origin);
    write_properties(joint, subject);
  }

  // The joint's line in both attachments: an axis of their frames where it is one, else by
  // coordinates.
  void write_axis(const urdf::Joint& joint, Id subject, Id parent_frame, Id parent_origin,
                  Id child_frame, Id child_origin) {
    const Id axis = node("joint-axis", joint.name);
    add(subject, vocab::kc::common_axis, axis);
    type(axis, {vocab::geom_rel::LineCollinearity});
    at(axis, joint.line);
    const double length = std::hypot(joint.axis[0], joint.axis[1], joint.axis[2]);
    Numbers3 direction = joint.axis;
    if (std::abs(length - 1) > 1e-15) {
      for (double& entry : direction) entry /= length;
    }
    // Beside an entry of exactly 1 there is room for others of up to 1e-8, a tilt to be kept.
    int along = -1;
    for (int i = 0; i < 3; ++i) {
      if (std::abs(direction[i]) == 1 && direction[(i + 1) % 3] == 0 && direction[(i + 2) % 3] == 0)
        along = i;
    }
    const bool negative = along >= 0 && direction[along] < 0;
    add(subject, vocab::kc::polarity,
        iri(negative ? vocab::skc::NegativePolarity : vocab::kc::PositivePolarity));

    constexpr std::string_view kVectors[] = {vocab::geom::vector_x, vocab::geom::vector_y,
                                             vocab::geom::vector_z};
    const auto line = [&](std::string_view kind, Id frame, Id origin) {
      in("geometry");
      const Id vector_node = node(kind, joint.name);
      type(vector_node, {vocab::geom::n3D, vocab::geom::Euclidean, vocab::geom::Vector,
                         vocab::geom::BoundVector, vocab::geom::UnitLength});
      add(vector_node, vocab::geom::start, origin);
      at(vector_node, joint.line);
      if (along >= 0) {
        add(frame, kVectors[along], vector_node);
      } else {
        const Id numbers = node(std::string(kind) + "-coordinates", joint.name);
        type(numbers, {vocab::sg::DirectionReference, vocab::geom_coord::DirectionCoordinate});
        add(numbers, vocab::sg::of_direction, vector_node);
        add(numbers, vocab::geom_coord::as_seen_by, frame);
        units(numbers, {"UNITLESS"});
        vector(numbers, direction);
        at(numbers, joint.line);
      }
      in("chain");
      add(axis, vocab::geom_rel::lines, vector_node);
    };
    line("parent-axis", parent_frame, parent_origin);
    line("child-axis", child_frame, child_origin);
  }

  // A node of its own for each thing that is said about a joint.
  Id property(const urdf::Joint& joint, Id subject, std::string_view kind,
              std::string_view type_iri, std::string_view unit_name) {
    const Id property_node = node(kind, joint.name);
    type(property_node, {vocab::kc_stat::JointReference, type_iri});
    add(property_node, vocab::kc_stat::of_joint, subject);
    units(property_node, {unit_name});
    at(property_node, joint.line);
    return property_node;
  }

  void write_properties(const urdf::Joint& joint, Id subject) {
    const bool slides = joint.type == urdf::JointType::kPrismatic;
    const std::string_view position = slides ? "M" : "RAD";
    if (joint.limit) {
      const urdf::Limit& limit = *joint.limit;
      const bool bounded = joint.type != urdf::JointType::kContinuous;
      if (bounded && (limit.lower || limit.upper)) {
        const Id limits =
            property(joint, subject, "position-limits", vocab::skc::JointPositionLimits, position);
        // In URDF, a bound that is not written is zero.
        number(limits, vocab::skc::lower, limit.lower.value_or(0));
        number(limits, vocab::skc::upper, limit.upper.value_or(0));
      }
      if (limit.velocity) {
        number(property(joint, subject, "velocity-limit", vocab::skc::JointVelocityLimit,
                        slides ? "M-PER-SEC" : "RAD-PER-SEC"),
               vocab::skc::maximum, *limit.velocity);
      }
      if (limit.effort) {
        number(property(joint, subject, "force-limit", vocab::skc::JointForceLimit,
                        slides ? "N" : "N-M"),
               vocab::skc::maximum, *limit.effort);
      }
    }
    if (joint.dynamics.damping) {
      number(property(joint, subject, "damping", vocab::skc::JointDamping,
                      slides ? "N-SEC-PER-M" : "N-M-SEC-PER-RAD"),
             vocab::skc::coefficient, *joint.dynamics.damping);
    }
    if (joint.dynamics.friction) {
      number(property(joint, subject, "friction", vocab::skc::JointFriction, slides ? "N" : "N-M"),
             vocab::skc::magnitude, *joint.dynamics.friction);
    }
    if (joint.mimic) {
      const Id mimicry = property(joint, subject, "mimicry", vocab::skc::JointMimicry, position);
      add(mimicry, vocab::skc::mimics, node("joint", joint.mimic->joint));
      number(mimicry, vocab::skc::multiplier, joint.mimic->multiplier);
      number(mimicry, vocab::skc::offset, joint.mimic->offset);
    }
  }

  const Document& document_;
  std::string base_;
  graph::Terms& terms_;
  graph::Transaction& transaction_;
  graph::Places& places_;
  std::uint32_t file_;
  Id graph_;
};

}  // namespace

void import_urdf(std::string_view text, const std::string& file, const UrdfOptions& options,
                 graph::Terms& terms, graph::Transaction& transaction, graph::Places& places,
                 Report& report) {
  Report found;
  const Document document = urdf::read(text, file, options.lenient, found);
  for (const Problem& problem : found.problems()) report.add(problem);
  if (found.has_errors()) return;
  const std::string base = options.base_iri.empty()
                               ? "https://w3id.org/sinew/robots/" + encoded(document.robot)
                               : options.base_iri;
  Importer(document, base, terms, transaction, places).run();
}

}  // namespace sinew::model
