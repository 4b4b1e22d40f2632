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

// After each closure `written` gets each variable that it wrote.
template <typename Written>
Computation trace_closures(const Program& program, Written&& written) {
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
    } else {
      sizes.clear();
      for (const std::uint32_t variable : closure.arguments) {
        sizes.push_back(program.variables[variable].size);
      }
      kernel.trace_many(arguments.data(), sizes);
    }
    for (std::size_t i = 0; i < closure.arguments.size(); ++i) {
      if (!kernel.port(i, closure.arguments.size()).output) continue;
      written(dag, closure.arguments[i], values[closure.arguments[i]]);
    }
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

}  // namespace

Computation trace(const Program& program) {
  return trace_closures(program, [](Dag&, std::uint32_t, std::vector<Traced>&) {});
}

Hoisted trace_with_held(const Program& program, const std::vector<bool>& held) {
  // The update has to see every value as it is, and the evaluation none that depends on another
  // held one: the closures are recorded twice.
  Hoisted parts;
  std::vector<Ref> numbers;  // of the held variables, in the order in which they are written
  parts.update =
      trace_closures(program, [&](Dag& dag, std::uint32_t variable, std::vector<Traced>& value) {
        if (!held[variable]) return;
        for (const Traced& number : value) numbers.push_back(number.in(dag));
      });
  const Dag& dag = parts.update.dag;
  parts.update.results.clear();
  for (const Ref number : numbers) {
    if (!dag.is_constant(number)) parts.update.results.push_back(number);
  }
  std::uint32_t next = parts.update.inputs;
  std::size_t at = 0;
  parts.evaluate =
      trace_closures(program, [&](Dag& fast, std::uint32_t variable, std::vector<Traced>& value) {
        if (!held[variable]) return;
        for (Traced& number : value) {
          const Ref known = numbers[at++];
          number = dag.is_constant(known) ? Traced(dag.constant_value(known))
                                          : Traced(fast, fast.input(next++));
        }
      });
  parts.evaluate.inputs = next;
  return parts;
}

}  // namespace sinew::program
