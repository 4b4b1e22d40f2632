#include "sinew/program/interface.h"

namespace sinew::program {

Interface interface_of(const Program& program) {
  Interface result;
  const auto append = [](std::vector<Slot>& slots, std::uint32_t& total, std::uint32_t variable,
                         std::uint32_t size) {
    slots.push_back({variable, total});
    total += size;
  };
  for (std::uint32_t i = 0; i < program.variables.size(); ++i) {
    const Variable& variable = program.variables[i];
    if (variable.role == Role::kInput) append(result.inputs, result.in_size, i, variable.size);
    if (variable.role == Role::kState) append(result.states, result.state_size, i, variable.size);
    if (variable.output) append(result.outputs, result.out_size, i, variable.size);
  }
  return result;
}

}  // namespace sinew::program
