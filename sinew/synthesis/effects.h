// The list of effects that hybrid dynamics propagates one by one: those of the groups of drivers,
// then those of the unit constraint forces.
#pragma once

#include <string>
#include <vector>

#include "sinew/synthesis/context.h"
#include "sinew/synthesis/joint_edge.h"

namespace sinew::synthesis {

struct Effect {
  Id element;
  std::string_view label;
  const DriverGroup* group = nullptr;  // without one, the effect of a unit constraint force
};
std::vector<Effect> effects(const Context& context);

// The block that an effect has in a slot at a joint, body or frame; algorithm::kNoIndex where it
// has none there.
BlockIndex effect_block(Context& context, std::string_view slot, Id effect, Id at);

// A joint's force or acceleration that belongs to an effect: named SLOT.EFFECT.JOINT.
BlockIndex make_joint_effect(Context& context, const JointEdge& edge, const Effect& effect,
                             std::string_view slot, std::string_view what);
// A wrench on a body that belongs to an effect, seen from a frame.
BlockIndex make_effect_wrench(Context& context, const Effect& effect, std::string_view slot, Id at,
                              Id of, Id frame);

// Constants: no wrench on a body; no force of a joint; zero energy; one and zero times a unit
// effect.
BlockIndex no_wrench(Context& context, Id frame, Id body);
BlockIndex no_force(Context& context, const JointEdge& edge);
BlockIndex no_energy(Context& context);
BlockIndex times(Context& context, double number);

// How many times a group of drivers counts: once, or what an input or the saturation policy says.
BlockIndex driver_weight(Context& context, const DriverGroup& group);

}  // namespace sinew::synthesis
