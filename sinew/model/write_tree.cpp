// The normalised tree as triples; the contract is in docs/architecture.md.
#include <cmath>

#include "sinew/graph/standard_iris.h"
#include "sinew/math/layout.h"
#include "sinew/model/tree.h"
#include "sinew/vocab/vocab.h"

namespace sinew::model {
namespace {

namespace t = vocab::tree;

class Writer {
 public:
  Writer(const Tree& tree, graph::Store& store)
      : tree_(tree),
        terms_(store.terms()),
        transaction_(store.begin()),
        graph_(terms_.iri(kNormalisedGraph)) {
    transaction_.clear(graph_);
  }

  void write() {
    write_bodies();
    write_joints();
    write_compounds();
    write_frames();
    const Id A = coordinate(t::base_acceleration, tree_.bodies[0].frame, tree_.base_acceleration,
                            {"RAD-PER-SEC2", "M-PER-SEC2"});
    add(tree_.bodies[0].frame, id(t::base_acceleration), A);
    transaction_.commit();
  }

 private:
  Id id(std::string_view iri) { return terms_.iri(iri); }
  void add(Id subject, Id predicate, Id object) {
    transaction_.add({subject, predicate, object, graph_});
  }
  void type(Id subject, std::string_view type) { add(subject, type_, id(type)); }

  // A node, named by its role and what it belongs to, that holds the numbers of a value in its
  // layout.
  template <typename Value>
  Id coordinate(std::string_view role, Id of, const Value& value,
                std::initializer_list<std::string_view> units) {
    double numbers[math::Layout<Value>::kSize];
    math::Layout<Value>::store(value, numbers);
    const Id node = terms_.derived(terms_.iri(role), {of, graph_});
    type(node, t::Coordinate);
    for (const std::string_view unit : units) {
      add(node, unit_, id("http://qudt.org/vocab/unit/" + std::string(unit)));
    }
    Id rest = nil_;
    for (std::size_t i = std::size(numbers); i-- > 0;) {
      const Id cell = terms_.fresh_blank();
      add(cell, first_, terms_.real(numbers[i]));
      add(cell, rest_, rest);
      rest = cell;
    }
    add(node, value_, rest);
    return node;
  }

  void write_bodies() {
    for (std::size_t b = 0; b < tree_.bodies.size(); ++b) {
      const Tree::Body& body = tree_.bodies[b];
      type(body.iri, t::Body);
      if (b == 0) type(body.iri, t::Root);
      add(body.iri, id(t::frame), body.frame);
      for (const Id link : body.links) add(body.iri, id(t::contains), link);
      if (!body.has_inertia) continue;
      add(body.iri, id(t::inertia),
          coordinate(t::inertia, body.iri, body.inertia, {"KiloGM", "M-KiloGM", "KiloGM-M2"}));
    }
  }

  void write_joints() {
    for (std::size_t k = 0; k < tree_.joints.size(); ++k) {
      const Tree::Joint& joint = tree_.joints[k];
      type(joint.iri, t::Joint);
      type(joint.iri, joint.kind == JointKind::kPrismatic ? t::Prismatic : t::Revolute);
      add(joint.iri, id(t::index), terms_.integer(static_cast<std::int64_t>(k)));
      add(joint.iri, id(t::predecessor_frame), tree_.bodies[joint.predecessor].frame);
      add(joint.iri, id(t::successor_frame), tree_.bodies[joint.successor].frame);
      add(joint.iri, id(t::joint_frame), joint.joint_frame);
      add(joint.iri, id(t::placement),
          coordinate(t::placement, joint.iri, joint.placement, {"UNITLESS", "M"}));
      limit(joint.iri, t::lower, joint.limits.lower);
      limit(joint.iri, t::upper, joint.limits.upper);
      limit(joint.iri, t::maximum_velocity, joint.limits.maximum_velocity);
      limit(joint.iri, t::maximum_force, joint.limits.maximum_force);
      if (joint.follows >= 0) {
        add(joint.iri, id(t::follows), tree_.joints[static_cast<std::size_t>(joint.follows)].iri);
        add(joint.iri, id(t::ratio), terms_.real(joint.ratio));
        add(joint.iri, id(t::offset), terms_.real(joint.offset));
      }
      if (joint.rotor_inertia != 0)
        add(joint.iri, id(t::rotor_inertia), terms_.real(joint.rotor_inertia));
    }
  }

  void write_compounds() {
    for (const Tree::Compound& compound : tree_.compounds) {
      type(compound.iri, t::Compound);
      type(compound.iri, type_of(compound.kind));
      Id rest = nil_;
      for (std::size_t k = compound.parts.size(); k-- > 0;) {
        const Id part = tree_.joints[compound.parts[k]].iri, cell = terms_.fresh_blank();
        add(part, id(t::part_of), compound.iri);
        add(cell, first_, part);
        add(cell, rest_, rest);
        rest = cell;
      }
      add(compound.iri, id(t::parts), rest);
    }
  }

  static std::string_view type_of(JointKind kind) {
    switch (kind) {
      case JointKind::kHelical:
        return t::Helical;
      case JointKind::kCylindrical:
        return t::Cylindrical;
      case JointKind::kPlanar:
        return t::Planar;
      case JointKind::kUniversal:
        return t::Universal;
      case JointKind::kSpherical:
        return t::Spherical;
      case JointKind::kFloating:
        return t::Floating;
      case JointKind::kComposite:
      case JointKind::kFixed:
      case JointKind::kRevolute:
      case JointKind::kPrismatic:
        break;
    }
    return t::Composite;
  }

  void limit(Id joint, std::string_view property, double value) {
    if (!std::isnan(value)) add(joint, id(property), terms_.real(value));
  }

  void write_frames() {
    for (const Tree::Frame& frame : tree_.frames) {
      const Id body_frame = tree_.bodies[frame.body].frame;
      if (frame.iri == body_frame) continue;
      add(frame.iri, id(t::fixed_to), body_frame);
      add(frame.iri, id(t::placement),
          coordinate(t::placement, frame.iri, frame.placement, {"UNITLESS", "M"}));
    }
    for (const Tree::Link& link : tree_.links) {
      if (link.root_frame) add(link.iri, id(t::root_frame), link.root_frame);
    }
  }

  const Tree& tree_;
  graph::Terms& terms_;
  graph::Transaction transaction_;
  Id graph_;
  Id type_ = terms_.iri(graph::kRdfType), first_ = terms_.iri(graph::kRdfFirst),
     rest_ = terms_.iri(graph::kRdfRest), nil_ = terms_.iri(graph::kRdfNil);
  Id unit_ = terms_.iri(vocab::qudt::unit), value_ = terms_.iri(t::value);
};

}  // namespace

void write(const Tree& tree, graph::Store& store) { Writer(tree, store).write(); }

}  // namespace sinew::model
