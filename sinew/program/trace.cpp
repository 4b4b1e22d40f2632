#include "sinew/program/trace.h"

#include "sinew/program/dag/derivative.h"
#include "sinew/program/interface.h"
#include "sinew/program/kernels.h"

namespace sinew::program {
namespace {

// The entries of a Jacobian; `values` are the numbers of each variable, `offset` is where an input
// variable's numbers begin.
void trace_derivative(const Derivative& derivative, const std::vector<std::uint32_t>& offset,
                      Computation& computation, std::vector<std::vector<Traced>>& values) {
  std::vector<std::uint32_t> rows, columns;
  std::vector<std::uint32_t> first_row(values.size()), first_column(values.size());
  Computation wanted;
  wanted.inputs = computation.inputs;
  for (const std::uint32_t variable : derivative.of) {
    first_row[variable] = static_cast<std::uint32_t>(rows.size());
    for (const Traced& number : values[variable]) {
      rows.push_back(static_cast<std::uint32_t>(wanted.results.size()));
      wanted.results.push_back(number.in(computation.dag));
    }
  }
  for (const std::uint32_t variable : derivative.by) {
    first_column[variable] = static_cast<std::uint32_t>(columns.size());
    for (std::uint32_t k = 0; k < values[variable].size(); ++k)
      columns.push_back(offset[variable] + k);
  }
  // The graph grows, so what has been recorded before keeps its nodes.
  wanted.dag = std::move(computation.dag);
  Computation jacobian = differentiate(wanted, rows, columns);
  computation.dag = std::move(jacobian.dag);
  for (const DerivativeEntry& entry : derivative.entries) {
    const std::size_t row = first_row[entry.of] + entry.of_number;
    const std::size_t column = first_column[entry.by] + entry.by_number;
    values[entry.variable] = {
        Traced(computation.dag, jacobian.results[row * columns.size() + column])};
  }
}

}  // namespace

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

  if (!program.derivatives.empty()) {
    std::vector<std::uint32_t> offset(values.size());
    for (const Slot& slot : interface.inputs) offset[slot.variable] = slot.offset;
    for (const Derivative& derivative : program.derivatives)
      trace_derivative(derivative, offset, computation, values);
  }

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
