// Quantities that a query holds at a lower rate than the rest (Held in query.h).
#pragma once

#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/synthesis/context.h"
#include "sinew/synthesis/resolve_query.h"

namespace sinew::synthesis {

// Marks their data blocks: inputs of what is given, results of what is asked, else whatever the
// steps have computed of that quantity. After the last sweep, when results have been handed out.
// Returns a line of explanation for each; what there is nothing of is reported.
std::vector<std::string> hold(Context& context, const Resolved& resolved, Report& report);

}  // namespace sinew::synthesis
