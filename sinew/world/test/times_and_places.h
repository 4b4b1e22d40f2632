// A time so many seconds after the clock's zero, and a pose without a turn.
#pragma once

#include "sinew/world/clock.h"
#include "sinew/world/pose.h"

namespace sinew::world {

inline Stamp at_s(double seconds) { return Stamp(duration_of_seconds(seconds)); }

inline Pose translation(double x, double y, double z) { return {{}, {x, y, z}}; }

}  // namespace sinew::world
