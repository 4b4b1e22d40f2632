// What is said of joints in nodes of its own: limits, the pitch of a screw, gears, and which joints
// follow others.
#include <fmt/format.h>

#include <cmath>
#include <unordered_set>

#include "sinew/model/read_joints.h"
#include "sinew/model/sizes.h"

namespace sinew::model {
namespace {

using Joint = Structure::Joint;

namespace d = dimension;
constexpr data::Dimension kPitch = {{1, 0, 0, 0, 0, 0, 0, -1}};

class Properties {
 public:
  Properties(GraphReader& reader, Structure& structure) : reader_(reader), structure_(structure) {
    for (Joint& joint : structure_.joints) {
      joints_.emplace(joint.iri, &joint);
      for (Structure::Motion& motion : joint.motions)
        if (motion.iri) motions_.emplace(motion.iri, &motion);
    }
  }

  void run() {
    read_limits();
    read_pitches();
    read_transmissions();
    read_mimicry();
  }

 private:
  // Calls read(node, joint) for each node of that type whose joint is there.
  template <typename Read>
  void each(Id type, Read&& read) {
    for (const Id node : reader_.all(type)) {
      const auto of = reader_.one(node, ids_.of_joint, "the joint that this is of");
      if (!of) continue;
      if (const auto found = joints_.find(*of); found != joints_.end()) {
        read(node, *found->second);
      } else if (!motions_.contains(*of) && !is_faulty(*of)) {
        reader_.error(node, ids_.of_joint, fmt::format("<{}> is no joint", reader_.text(*of)),
                      "name a joint of these models");
      }
    }
  }

  // A joint of the model with a fault of its own, which has been reported.
  bool is_faulty(Id joint) const { return reader_.is_a(joint, ids_.joint); }

  void scaled(Id node, Id property, const data::Dimension& dimension, std::string_view what,
              double& to) {
    if (!reader_.has(node, property)) return;
    if (!stated_.insert(&to).second) {
      reader_.error(node, property, fmt::format("{} is stated already", what),
                    "state it once for each degree of freedom");
      return;
    }
    const auto value = reader_.number(node, property);
    const auto scale = reader_.scale(node, dimension, what);
    if (value && scale) to = *value * *scale;
  }

  // Limits are of a joint with one degree of freedom, of one motion of a sequence, or of the degree
  // of freedom that the node names.
  struct Limited {
    JointLimits* limits = nullptr;
    bool turns = true;
    bool free = false;  // its positions are a quaternion's
  };
  std::optional<Limited> limited(Id node) {
    const auto of = reader_.one(node, ids_.of_joint, "the joint that this is of");
    if (!of) return std::nullopt;
    if (const auto motion = motions_.find(*of); motion != motions_.end())
      return Limited{&motion->second->limits, motion->second->kind == JointKind::kRevolute};
    const auto found = joints_.find(*of);
    if (found == joints_.end()) {
      if (is_faulty(*of)) return std::nullopt;
      reader_.error(node, ids_.of_joint, fmt::format("<{}> is no joint", reader_.text(*of)),
                    "name a joint of these models");
      return std::nullopt;
    }
    Joint& joint = *found->second;
    if (joint.motions.empty()) return Limited{&joint.limits, joint.kind != JointKind::kPrismatic};
    if (joint.kind == JointKind::kHelical) return Limited{&joint.motions[0].limits, true};
    const Id degree = reader_.view.object(node, ids_.degree_of_freedom);
    const auto number = degree ? reader_.view.terms().integer_value(degree) : std::nullopt;
    if (!number || *number < 0 || *number >= static_cast<std::int64_t>(joint.motions.size())) {
      reader_.error(node, ids_.degree_of_freedom,
                    fmt::format("<{}> has {} degrees of freedom, and this does not say of which "
                                "the limit is",
                                reader_.text(joint.iri), joint.motions.size()),
                    fmt::format("state degree-of-freedom, 0 to {}", joint.motions.size() - 1));
      return std::nullopt;
    }
    Structure::Motion& motion = joint.motions[static_cast<std::size_t>(*number)];
    return Limited{&motion.limits, motion.kind == JointKind::kRevolute, is_free(joint.kind)};
  }

  void read_limits() {
    for (const Id node : reader_.all(ids_.position_limits)) {
      const auto of = limited(node);
      if (!of) continue;
      if (of->free) {
        reader_.error(node, ids_.of_joint,
                      "a spherical or floating joint has no positions to limit one by one",
                      "limit its velocities and forces, or make it a CompositeJoint");
        continue;
      }
      const auto& dimension = of->turns ? d::kAngle : d::kLength;
      scaled(node, ids_.lower, dimension, "the lower limit", of->limits->lower);
      scaled(node, ids_.upper, dimension, "the upper limit", of->limits->upper);
    }
    for (const Id node : reader_.all(ids_.velocity_limit)) {
      if (const auto of = limited(node))
        scaled(node, ids_.maximum, of->turns ? d::kAngularVelocity : d::kVelocity,
               "the velocity limit", of->limits->maximum_velocity);
    }
    for (const Id node : reader_.all(ids_.force_limit)) {
      if (const auto of = limited(node))
        scaled(node, ids_.maximum, of->turns ? d::kTorque : d::kForce, "the force limit",
               of->limits->maximum_force);
    }
  }

  void read_pitches() {
    each(ids_.joint_pitch, [&](Id node, Joint& joint) {
      if (joint.kind != JointKind::kHelical) {
        reader_.error(
            node, ids_.of_joint,
            fmt::format("<{}> has a pitch but is no helical joint", reader_.text(joint.iri)),
            "make it a HelicalJoint, or leave the pitch out");
        return;
      }
      scaled(node, ids_.pitch, kPitch, "the pitch", joint.motions[1].ratio);
    });
    for (const Joint& joint : structure_.joints) {
      if (joint.kind != JointKind::kHelical || !std::isnan(joint.motions[1].ratio)) continue;
      reader_.error(joint.iri, ids_.type, "the helical joint has no pitch",
                    "state a JointPitch of it, for example in M-PER-RAD");
    }
  }

  // A rotor that turns `ratio` times as fast as the joint moves adds ratio^2 of its inertia.
  void read_transmissions() {
    each(ids_.transmission, [&](Id node, Joint& joint) {
      const auto ratio = reader_.number(node, ids_.transmission_ratio);
      const auto inertia = reader_.number(node, ids_.rotor_inertia);
      const auto scale = reader_.scale(node, d::kInertia, "the rotor's inertia");
      if (!ratio || !inertia || !scale) return;
      const bool one = joint.motions.empty() || joint.kind == JointKind::kHelical;
      if (joint.kind == JointKind::kFixed || !one) {
        reader_.error(node, ids_.of_joint,
                      fmt::format("<{}> has not one degree of freedom that a rotor could drive",
                                  reader_.text(joint.iri)),
                      "name a revolute, prismatic or helical joint");
        return;
      }
      if (*inertia < 0) {
        reader_.error(node, ids_.rotor_inertia, "the rotor's inertia is negative",
                      "give a moment of inertia of a real body");
        return;
      }
      if (joint.rotor_inertia != 0) {
        reader_.error(node, ids_.of_joint,
                      fmt::format("<{}> has a transmission already", reader_.text(joint.iri)),
                      "state one");
        return;
      }
      const double reflected = *ratio * *ratio * *inertia * *scale;
      const bool vanishes = reflected < kSmallestMoment && *ratio != 0 && *inertia != 0;
      if (vanishes || !within(reflected, kLargestMoment)) {
        reader_.error(node, ids_.transmission_ratio,
                      fmt::format("what the joint feels of the rotor is {:g} kg m^2, not between "
                                  "{:g} and {:g}",
                                  reflected, kSmallestMoment, kLargestMoment),
                      "check the ratio, the inertia and its unit");
        return;
      }
      joint.rotor_inertia = reflected;
    });
  }

  void read_mimicry() {
    each(ids_.mimicry, [&](Id node, Joint& joint) {
      const auto leader = reader_.one(node, ids_.mimics, "the joint that is mimicked");
      const auto multiplier = reader_.number(node, ids_.multiplier);
      const auto offset = reader_.number(node, ids_.mimic_offset);
      const auto scale =
          reader_.scale(node, joint.kind == JointKind::kPrismatic ? d::kLength : d::kAngle,
                        "the offset of a joint that mimics another");
      if (!leader || !multiplier || !offset || !scale) return;
      if (joint.mimicry) {
        reader_.error(node, ids_.of_joint,
                      fmt::format("<{}> mimics another joint already", reader_.text(joint.iri)),
                      "let it mimic one joint");
        return;
      }
      joint.mimicry = Structure::Mimicry{node, *leader, *multiplier, *offset * *scale};
    });
  }

  GraphReader& reader_;
  Structure& structure_;
  const Ids& ids_ = reader_.ids;
  std::unordered_map<Id, Joint*> joints_;
  std::unordered_map<Id, Structure::Motion*> motions_;
  std::unordered_set<const double*> stated_;  // limits and pitches
};

}  // namespace

void read_joint_properties(GraphReader& reader, Structure& structure) {
  Properties(reader, structure).run();
}

}  // namespace sinew::model
