// The normalised kinematic tree as plain numbers: bodies, the joints that move them, and every
// frame that is fixed to a body, in SI units. The same facts, as triples, are the contract of
// docs/architecture.md; `write` makes them. Tests, benchmarks and later passes use the numbers.
//
// Body 0 is the root; joint k moves body k + 1 and has tree:index k. Predecessors come before
// successors.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/math/inertia.h"
#include "sinew/math/pose.h"
#include "sinew/math/twist.h"

namespace sinew::model {

using graph::Id;
using Vector3 = math::Vector3<double>;
using Matrix3 = math::Matrix3<double>;
using Pose = math::Pose<double>;
using RigidBodyInertia = math::RigidBodyInertia<double>;
using AccelerationTwist = math::AccelerationTwist<double>;

// The first three are what a tree's joints are made of. The others are compounds: a tree has a
// sequence of turns and slides for each, with bodies that weigh nothing between them.
enum class JointKind : std::uint8_t {
  kFixed,
  kRevolute,
  kPrismatic,
  kHelical,      // a turn, and a slide that follows it
  kCylindrical,  // a turn and a slide, about and along one axis
  kPlanar,       // two slides and a turn about their normal
  kUniversal,    // two turns
  kComposite,    // as its sequence says
  kSpherical,    // a quaternion; three turns about the successor's x, y, z
  kFloating,     // a position and a quaternion; three turns and three slides likewise
};

// Whether its velocities are about (along) axes of the successor, wherever it has turned.
constexpr bool is_free(JointKind kind) {
  return kind == JointKind::kSpherical || kind == JointKind::kFloating;
}

// Not a number means: not stated.
struct JointLimits {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double lower = kNone, upper = kNone;  // rad or m
  double maximum_velocity = kNone;      // rad/s or m/s
  double maximum_force = kNone;         // N m or N
};

struct Tree {
  // Links that are fixed to each other.
  struct Body {
    Id iri;                 // that of its first link from the base
    Id frame;               // F: inertia, twists and wrenches of the body are seen from it
    std::vector<Id> links;  // in order of appearance, the first link first
    bool has_inertia = false;
    RigidBodyInertia inertia;  // about the origin of F
  };

  // F_C, the successor's frame, coincides at joint position zero with F_J, which is fixed to the
  // predecessor. Both have z on the joint's axis, the way in which the position grows.
  struct Joint {
    Id iri;
    JointKind kind = JointKind::kRevolute;
    std::uint32_t predecessor = 0, successor = 0;  // bodies
    Id joint_frame;                                // F_J
    Pose placement;                                // pose of F_J in the predecessor's frame
    bool against_its_direction = false;            // walked from the model's child to its parent
    JointLimits limits;

    int compound = -1;  // that it is a part of
    // Its position is `ratio` times that of another joint (in SI units) plus `offset`; -1: it is
    // free.
    int follows = -1;
    double ratio = 1, offset = 0;
    // What the joint feels of a rotor behind a gear [kg m^2, or kg of a slide].
    double rotor_inertia = 0;
  };

  // A joint of the model that is a sequence of the tree's joints. The model's numbers of it
  // (positions, velocities, …) are those of the parts that follow nothing, in this order; only the
  // position of a spherical or floating joint is not the parts'.
  struct Compound {
    Id iri;
    JointKind kind = JointKind::kComposite;
    std::vector<std::uint32_t> parts;  // joints
  };

  // A frame of the model, or the frame of a link.
  struct Frame {
    Id iri;
    std::uint32_t body = 0;
    Pose placement;  // pose of it in the body's frame; the identity if it is that frame
  };

  struct Link {
    Id iri;
    std::uint32_t body = 0;
    Id root_frame;  // the frame that the model gives the link's data in; one of `frames`
  };

  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<Compound> compounds;
  std::vector<Frame> frames;  // in order of appearance
  std::vector<Link> links;    // in order of appearance

  // Of the root body's frame, seen from it: minus the gravity vector.
  AccelerationTwist base_acceleration;
  // What a user should know: no gravity stated, links without mass, units converted, …
  std::vector<std::string> notes;

  // Null when there is none.
  const Frame* find_frame(Id iri) const;
  const Link* find_link(Id iri) const;
  const Joint* find_joint(Id iri) const;
  // The joints from the root to a body, the first from the root first.
  std::vector<std::uint32_t> path(std::uint32_t body) const;
};

// The named graph that holds the normalised tree.
inline constexpr std::string_view kNormalisedGraph = "https://w3id.org/sinew/normalised";

// Replaces what that graph holds by the tree's triples.
void write(const Tree& tree, graph::Store& store);

}  // namespace sinew::model
