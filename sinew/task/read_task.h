// Reads the task of a model's graph. What is at fault goes to the report, with its place, its IRI
// and the remedy: a gain that is missing or a number alone, a unit whose dimension does not fit the
// formula, an axis that is not stated, two elements that give one number its value.
#pragma once

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/task/task.h"

namespace sinew::task {

// The task of all files that were loaded; empty() where they hold none.
Task read_task(graph::Store& store, const graph::Places& places, Report& report);

}  // namespace sinew::task
