#include "sinew/program/dead_closures.h"

#include <algorithm>
#include <utility>

#include "sinew/program/kernels.h"

namespace sinew::program {

Program without_dead_closures(Program program) {
  std::vector<bool> needed(program.variables.size(), false);
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const Variable& v = program.variables[i];
    needed[i] = v.output || v.role == Role::kState || v.role == Role::kInput;
  }
  std::vector<bool> live(program.schedule.size(), false);
  for (std::size_t s = program.schedule.size(); s-- > 0;) {
    const Closure& closure = program.closures[program.schedule[s]];
    const Kernel& kernel = *find_kernel(closure.operation);
    for (std::size_t i = 0; i < closure.arguments.size(); ++i) {
      if (kernel.port(i, closure.arguments.size()).output && needed[closure.arguments[i]])
        live[s] = true;
    }
    if (!live[s]) continue;
    for (const std::uint32_t argument : closure.arguments) needed[argument] = true;
  }

  Program result;
  result.name = std::move(program.name);
  result.iri = std::move(program.iri);
  std::vector<std::uint32_t> moved(program.variables.size(), 0);
  result.variables.reserve(static_cast<std::size_t>(std::ranges::count(needed, true)));
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (!needed[i]) continue;
    moved[i] = static_cast<std::uint32_t>(result.variables.size());
    result.variables.push_back(std::move(program.variables[i]));
  }
  result.schedule.reserve(static_cast<std::size_t>(std::ranges::count(live, true)));
  result.closures.reserve(result.schedule.capacity());
  for (std::size_t s = 0; s < live.size(); ++s) {
    if (!live[s]) continue;
    Closure closure = std::move(program.closures[program.schedule[s]]);
    for (std::uint32_t& argument : closure.arguments) argument = moved[argument];
    result.schedule.push_back(static_cast<std::uint32_t>(result.closures.size()));
    result.closures.push_back(std::move(closure));
  }
  // Rows, columns and entries are outputs and inputs, which all stay.
  result.derivatives = std::move(program.derivatives);
  for (Derivative& derivative : result.derivatives) {
    for (std::uint32_t& variable : derivative.of) variable = moved[variable];
    for (std::uint32_t& variable : derivative.by) variable = moved[variable];
    for (DerivativeEntry& entry : derivative.entries)
      for (std::uint32_t* variable : {&entry.variable, &entry.of, &entry.by})
        *variable = moved[*variable];
  }
  return result;
}

}  // namespace sinew::program
