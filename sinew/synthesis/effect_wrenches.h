// The wrench with which each effect (effects.h) acts on a body, in the slot "effect-wrench" of the
// effect and the body's frame: what drivers exert on it, and the unit constraint forces; with what
// the joints behind the body have handed on already.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/synthesis/effects.h"

namespace sinew::synthesis {

// The two passes of a visitor of bodies, for these effects.
void configure_effect_wrenches(Context& context, const Visit& visit, std::span<const Effect> list);
void compute_effect_wrenches(Context& context, const Visit& visit, std::span<const Effect> list);

// What an effect exerts at frames of bodies: all of it, or a constraint force by itself, which
// needs to know of no joint but those on its way to the base.
inline constexpr std::string_view kEffectWrench = "effect-wrench";
inline constexpr std::string_view kLeverWrench = "lever-wrench";

// The wrench of an effect in this slot goes on past a joint: to the joint's frame and the
// predecessor's, where it comes on top of what is there. The second pass begins with `wrench`, seen
// from the successor.
void configure_wrench_past_joint(Context& context, const JointEdge& edge, const Effect& effect,
                                 std::string_view slot);
void compute_wrench_past_joint(Context& context, const JointEdge& edge, const Effect& effect,
                               std::string_view slot, BlockIndex wrench);

// What a step needs that takes wrenches and given forces of all groups of drivers inward.
std::vector<std::string> needs_of_driver_wrenches(const MotionDrivers& drivers);

}  // namespace sinew::synthesis
