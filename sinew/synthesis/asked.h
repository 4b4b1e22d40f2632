// What can be asked and what can be given, as tables: how the words of a query map to slots of the
// blackboard, which is what the planner and the steps speak of.
#pragma once

#include <span>
#include <string_view>

namespace sinew::synthesis {

// What a quantity belongs to.
enum class Element : std::uint8_t {
  kFrame,
  kJoint,
  kRobot,
  kConstraint,   // each constrained direction
  kDriver,       // each group of drivers
  kDriverJoint,  // each group of drivers at each joint
  kLimited,      // the group that is scaled down
};

struct AskedQuantity {
  std::string_view name;  // "joint-force"
  Element element;
  std::string_view needs;  // what the planner must see to
  std::string_view slot;   // where the data block then is; also the output's name before the dot
  bool regroups;           // the same after inertias have been regrouped (regroup.h)
  bool dynamic;            // speaks of masses: the whole robot matters, not the way to a tip alone
  // What the planner must see to between any two frames; empty: it is of one element alone. The
  // same as `needs` where there is no shorter way from the base.
  std::string_view between = {};
};

struct GivenQuantity {
  std::string_view name;  // "joint-position"
  Element element;
  std::string_view slot;
};

std::span<const AskedQuantity> asked_quantities();
std::span<const GivenQuantity> given_quantities();
const AskedQuantity* find_asked(std::string_view name);  // nullptr when there is none
const GivenQuantity* find_given(std::string_view name);
// The given quantity that fills a slot, or nullptr.
const GivenQuantity* find_given_for(std::string_view slot);

}  // namespace sinew::synthesis
