// The external closures of the catalogue as actions: one function each, found by the operator's
// name. Binding is design time and throws Error; the actions are real-time safe.
#pragma once

#include <vector>

#include "sinew/runtime/executable.h"

namespace sinew::runtime {

struct BoundExternal {
  Action action;
  Action safe;  // of `write`: the declared safe command; otherwise empty
  const RobotInterface* commands = nullptr;  // of `write`
};

// `blocks` lie in `storage`, which must outlive the action.
BoundExternal bind_external(const program::External& external, Storage& storage,
                            const Bindings& bindings);

// The names of single numbers, as they head CSV columns: a block of one number has its own name,
// one of more has NAME[0], NAME[1], ...
std::vector<std::string> column_names(const program::Variable& block);

}  // namespace sinew::runtime
