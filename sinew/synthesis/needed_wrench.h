// What joints transmit, which several steps look at.
#pragma once

#include "sinew/synthesis/context.h"
#include "sinew/synthesis/motion.h"

namespace sinew::synthesis {

// The wrench that a body needs from its joint, for itself and for the successors that the inward
// sweep has seen until now.
BlockIndex needed_wrench_so_far(Motion motion, const Context& context, Id frame);

}  // namespace sinew::synthesis
