// --constraint, --singular, --drivers and --limit: what they add to a query.
#pragma once

#include "request.h"
#include "sinew/synthesis/query.h"

namespace sinew::cli {

// Error, naming the option, where one is not well written.
void apply_driver_options(const QueryOptions& options, synthesis::Query& query);

}  // namespace sinew::cli
