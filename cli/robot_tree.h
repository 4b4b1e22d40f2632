// The robot among the models as a normalised tree, whatever is asked of it.
#pragma once

#include "pipeline.h"
#include "sinew/model/tree.h"

namespace sinew::cli {

// With the query's base and gravity. Throws Error.
model::Tree robot_tree(Models& models, const QueryOptions& query);

}  // namespace sinew::cli
