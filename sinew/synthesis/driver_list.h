// The list of drivers of an algorithm: its entries are what drivers contribute, each with its index
// and a link to where it comes from, so that whoever reads or rewrites the algorithm can find the
// effects of each.
#pragma once

#include <vector>

#include "sinew/synthesis/asked.h"
#include "sinew/synthesis/context.h"
#include "sinew/synthesis/plan.h"

namespace sinew::synthesis {

// What a question about constraints or drivers is about, in the order of the outputs; Error where
// there is nothing of the kind.
std::vector<Id> driver_elements(graph::Store& store, const Robot& robot, const Query& query,
                                const MotionDrivers& drivers, const Asked& asked, Element kind);

// The frames that are constrained, each once.
std::vector<Id> constrained_frames(const MotionDrivers& drivers);

// Nothing that is given may be left out in silence: refuses drivers that no step of the plan uses.
void check_drivers_are_used(const MotionDrivers& drivers, const Plan& plan, Report& report);

// Into the algorithm's graph:
//   ALGORITHM sa:drivers ( DRIVER... ) .
//   DRIVER a sa:Driver ; sa:at-index k ; sa:origin ORIGIN ; sa:name LABEL ; sa:effect BLOCK... .
void write_driver_list(const Context& context, graph::Transaction& transaction);

}  // namespace sinew::synthesis
