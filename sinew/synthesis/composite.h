// Composite bodies, which several steps look at.
#pragma once

#include "sinew/synthesis/context.h"

namespace sinew::synthesis {

// The inertia of what moves with a body while the joints behind it are held: itself, and the
// successors that the inward sweep has seen until now. Seen from the body's frame; all zero where
// there is none.
BlockIndex composite_so_far(Context& context, Id frame, Id body);

}  // namespace sinew::synthesis
