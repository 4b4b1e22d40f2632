#include "sinew/program/trace.h"

#include "sinew/program/interface.h"
#include "sinew/program/kernels.h"

namespace sinew::program {

Computation trace(const Program& program) {
  const Interface interface = interface_of(program);
  Computation computation;
  computation.inputs = interface.in_size + interface.state_size;
  Dag& dag = computation.dag;

  std::vector<std::vector<Traced>> values(program.variables.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Variable& v = program.variables[i];
    if (v.role == Role::kConstant) {
      values[i].assign(v.value.begin(), v.value.end());
    } else {
      values[i].resize(v.size);
    }
  }
  const auto read = [&](const Slot& slot, std::uint32_t first) {
    std::vector<Traced>& value = values[slot.variable];
    for (std::uint32_t k = 0; k < value.size(); ++k) {
      value[k] = Traced(dag, dag.input(first + slot.offset + k));
    }
  };
  for (const Slot& slot : interface.inputs) read(slot, 0);
  for (const Slot& slot : interface.states) read(slot, interface.in_size);

  std::vector<Traced*> arguments;
  std::vector<std::uint32_t> sizes;
  for (const std::uint32_t index : program.schedule) {
    const Closure& closure = program.closures[index];
    arguments.clear();
    for (const std::uint32_t variable : closure.arguments) {
      arguments.push_back(values[variable].data());
    }
    dag.set_origin(index);
    const Kernel& kernel = *find_kernel(closure.operation);
    if (!kernel.many()) {
      kernel.trace(arguments.data());
      continue;
    }
    sizes.clear();
    for (const std::uint32_t variable : closure.arguments) {
      sizes.push_back(program.variables[variable].size);
    }
    kernel.trace_many(arguments.data(), sizes);
  }
  dag.set_origin(kNoOrigin);

  const auto write = [&](const Slot& slot) {
    for (const Traced& value : values[slot.variable]) {
      computation.results.push_back(value.in(dag));
    }
  };
  for (const Slot& slot : interface.outputs) write(slot);
  for (const Slot& slot : interface.states) write(slot);
  return computation;
}

}  // namespace sinew::program
