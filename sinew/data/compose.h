// Where closures meet: the output of one is the input of another, and each says by a data prototype
// what it gives or takes. Where the prototypes differ but mean the same, a conversion goes between
// them; where they do not, the composition is refused, naming both.
#pragma once

#include <string>
#include <vector>

#include "sinew/data/plan.h"

namespace sinew::data {

// One port of a closure, and the prototype that it is declared with.
struct Port {
  std::string closure, port, prototype;
  Place place;
};
// Data goes from an output to an input.
struct Connection {
  Port output, input;
};

// A closure to be put between two others, with the block that it writes.
struct InsertedConversion {
  std::string closure;  // "convert.SOURCE_BLOCK.PROTOTYPE": the same for the same composition
  std::string block;    // the block of the target's prototype that it writes and the consumers read
  Plan plan;
  std::vector<std::string> inputs;       // relations that it reads besides, as in "tool in base"
  std::vector<std::size_t> connections;  // those that read the block, by index
};

// The conversions that the connections need, in order of the first connection that needs each.
// Inputs that take one output in one prototype share a conversion. Throws Error with every
// connection that cannot be made.
std::vector<InsertedConversion> insert_conversions(const Library& library,
                                                   const std::vector<Connection>& connections,
                                                   const PlanOptions& options = {});

}  // namespace sinew::data
