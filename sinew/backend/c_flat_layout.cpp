#include <fmt/format.h>

#include "sinew/backend/c_flat_body.h"

namespace sinew::backend {
namespace {

// Inputs, then states: as trace.h numbers them.
FlatLayout caller_layout(const program::Program& program, const program::Interface& interface,
                         const std::vector<std::string>& identifiers) {
  FlatLayout layout;
  layout.in_size = interface.in_size;
  const auto add = [&](const std::vector<program::Slot>& slots, const char* array) {
    for (const program::Slot& slot : slots) {
      const std::uint32_t size = program.variables[slot.variable].size;
      for (std::uint32_t k = 0; k < size; ++k) {
        layout.inputs.push_back({array, slot.offset + k});
        layout.input_names.push_back(size == 1
                                         ? identifiers[slot.variable]
                                         : fmt::format("{}_{}", identifiers[slot.variable], k));
      }
    }
  };
  add(interface.inputs, "in");
  add(interface.states, "state");
  return layout;
}

}  // namespace

FlatLayout evaluation_layout(const program::Program& program, const program::Interface& interface,
                             const std::vector<std::string>& identifiers,
                             const program::Computation& evaluation) {
  FlatLayout layout = caller_layout(program, interface, identifiers);
  for (auto k = static_cast<std::uint32_t>(layout.inputs.size()); k < evaluation.inputs; ++k) {
    const std::uint32_t index = k - interface.in_size - interface.state_size;
    layout.inputs.push_back({"held", index});
    layout.input_names.push_back(fmt::format("h{}", index));
  }
  for (std::uint32_t k = 0; k < interface.out_size; ++k) layout.results.push_back({"out", k});
  for (std::uint32_t k = 0; k < interface.state_size; ++k) layout.results.push_back({"state", k});
  return layout;
}

FlatLayout update_layout(const program::Program& program, const program::Interface& interface,
                         const std::vector<std::string>& identifiers,
                         const program::Computation& update) {
  FlatLayout layout = caller_layout(program, interface, identifiers);
  for (std::uint32_t k = 0; k < update.results.size(); ++k) layout.results.push_back({"held", k});
  return layout;
}

}  // namespace sinew::backend
