// A pose query as a program: the way through the graph becomes an algorithm model (the builder that
// synthesis uses), is lowered, and is then interpreted, compiled or turned into source like any
// other. For whoever computes poses outside the world: on a controller, in another process.
//
// Constants of the way are in the program; each measurement on it is an input: a pose (12 numbers)
// or a joint position. What the query decides while it runs (the freshest of several measurements,
// predictions, freshness) is not in the program: it takes the measurement that is preferred when it
// is made, and `gather` applies the life-cycle.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/program/program.h"
#include "sinew/world/world.h"

namespace sinew::world {

struct PoseProgram {
  struct Input {
    MeasurementId measurement;
    Quantity quantity = Quantity::kPose;
    std::uint32_t offset = 0;  // of its first number among the program's inputs
  };
  graph::Id algorithm;       // in the store that it was written to
  program::Program program;  // one output: pose.FRAME, 12 numbers, row-major [R p]
  std::vector<Input> inputs;
  std::uint32_t in_size = 0;
  std::uint64_t structure_version = 0;  // of the world when it was made

  // The inputs as the world has them; the first status that is not kOk.
  Status gather(const World& world, Stamp now, std::span<double> in) const;
};

// Writes the algorithm into the store, in a graph of its own, and lowers it. Throws Error when
// there is no way between the frames.
PoseProgram make_pose_program(const World& world, const PoseQuery& query, graph::Store& store,
                              std::string_view name);

}  // namespace sinew::world
