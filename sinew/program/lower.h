// From the algorithm model in the graph to a program: the graph becomes a tree, symbols become
// indices, closures that nothing depends on are left out. The same model gives the same program,
// byte for byte.
//
// External closures (read, write, log, ...) are the host's (host_plan.h) and leave the program;
// what they take becomes an output of it, so an algorithm without them lowers to the same bytes as
// before they were woven in.
#pragma once

#include <string_view>

#include "sinew/algorithm/model.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/program/program.h"

namespace sinew::program {

// Reads and checks the algorithm (algorithm/check.h): whatever is wrong is thrown as one Error with
// the IRIs of the closures and data blocks at fault. Variables come in this order: inputs, outputs,
// then the others as the schedule meets them.
Program lower(const graph::View& view, graph::Id algorithm, std::string_view name,
              const graph::Places* places = nullptr);

// The same for an algorithm that has been read and checked.
Program lower(const algorithm::Algorithm& model, const graph::Terms& terms, std::string_view name);
Program lower(algorithm::Algorithm&& model, const graph::Terms& terms, std::string_view name);

}  // namespace sinew::program
