// The passes of steps that are data: what an INSERT says becomes data blocks and closures.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/rdf/sparql/prepared_insert.h"
#include "sinew/synthesis/step.h"

namespace sinew::synthesis {

struct InsertPass {
  std::string step;                // IRI, for messages
  Place place;                     // of the INSERT
  std::vector<std::string> slots;  // those that it can see
  std::shared_ptr<const rdf::sparql::PreparedInsert> insert;
};

// Runs it, with ?node, ?parent and ?algorithm bound, and hands what it describes to the builder.
// Error, with the pass' place, where that is nothing that an algorithm can be made of.
Pass insert_pass(InsertPass pass);

}  // namespace sinew::synthesis
