// What a run with a robot tells on standard error.
#pragma once

#include "sinew/runtime/host.h"

namespace sinew::cli {

// Events, cycles, times, the log. `timed`: the loop had a clock.
void report(runtime::Host& host, const runtime::Recorder* recorder, bool timed);

// "carried over signal.x; initialised signal.y": what a swap does to states and set points.
std::string describe(const runtime::SwapReport& report);

}  // namespace sinew::cli
