// A conversion as straight-line code: loads from the source, arithmetic, calls of functions, stores
// into the target. Both outputs are made from it: source code (emit.h) and the operation list
// (engine.h).
//
// Units and signs are folded here: the scale and offset of a number that is only moved become one
// multiplication and one addition, or nothing.
#pragma once

#include <string>
#include <vector>

#include "sinew/data/plan.h"
#include "sinew/data/scalar_graph.h"

namespace sinew::data {

struct ConversionProgram {
  // Memory that is read or written: 0 is the source, 1 the target, then the relations between
  // frames that are given, then intermediate values of functions.
  struct Block {
    std::string name;     // for source code
    Index prototype = 0;  // whose representation it has
  };
  struct Load {  // input i of the graph
    Index block = 0;
    Access access;
    std::string label;  // what it means
  };
  struct Store {
    Index block = 0;
    Access access;
    ScalarGraph::Node value = 0;
  };
  struct Call {
    Index function = 0;
    std::vector<Index> blocks;  // by argument position; the return value's first
  };
  // First the stores, then the calls. What a later stage loads from an intermediate block is there
  // by then.
  struct Stage {
    std::vector<Store> stores;
    std::vector<Call> calls;
  };
  std::vector<Block> blocks;
  std::size_t inputs = 0;  // how many relations are given
  bool is_parameter(Index block) const { return block < 2 + inputs; }
  std::vector<Load> loads;
  ScalarGraph graph;
  std::vector<Stage> stages;

  int operations() const;  // loads, stores, calls and the arithmetic between them
};

ConversionProgram lower(const Library& library, const Plan& plan);

}  // namespace sinew::data
