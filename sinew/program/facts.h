// What the operator catalogue knows of each closure, as triples in its algorithm's graph, so that
// queries can add it up (statistics/) and updates can build on it (weaves/depths.rq):
//
//   CLOSURE sa:reads BLOCK, … ; sa:writes BLOCK, … ;
//           sa:additions n ; sa:multiplications n ; sa:divisions n ; sa:square-roots n ;
//           sa:sines-and-cosines n ; sa:choices n
//
// The costs are those of the operator by itself, for blocks of these sizes of which nothing is
// known: what readable C calls. Code that is optimised as a whole needs fewer (`sinew stats`).
#pragma once

#include <cstddef>
#include <span>

#include "sinew/graph/store.h"
#include "sinew/program/dag/evaluate.h"
#include "sinew/program/kernels.h"
#include "sinew/program/program.h"

namespace sinew::program {

// `sizes` has one entry for each argument, in the order of the operator's ports.
OperationCount cost_of(const Kernel& kernel, std::span<const std::uint32_t> sizes);

// Closures on the longest way from an input to a result, each waiting for the one before.
// Precondition: the program is valid.
std::size_t longest_chain(const Program& program);

// Writes the facts of every pure closure, and removes those that were there. External closures
// compute nothing, and have none. Throws Error when the algorithm is at fault.
void write_facts(graph::Store& store, graph::Id algorithm);

}  // namespace sinew::program
