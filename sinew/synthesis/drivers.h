// Drivers: what a query gives, as data blocks on the blackboard before the first sweep.
#pragma once

#include "sinew/base/error.h"
#include "sinew/synthesis/context.h"

namespace sinew::synthesis {

// The data block of a joint's position, velocity, acceleration or force.
algorithm::BlockSpec joint_quantity(std::string_view slot, const RobotJoint& joint);

// Makes the inputs: all positions, then velocities, accelerations and forces, each in the order of
// the joints, whatever the order in the query; then external wrenches. Gravity becomes a constant
// acceleration of the root, or the input "gravity". Unknown or repeated drivers are reported.
void make_drivers(Context& context, Report& report);

// The slots that drivers fill.
std::vector<std::string> given_slots(const Query& query);

// Whether gravity is an input.
bool gravity_varies(const Query& query);

}  // namespace sinew::synthesis
