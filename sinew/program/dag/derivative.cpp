#include "sinew/program/dag/derivative.h"

#include <array>
#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/program/dag/evaluate.h"

namespace sinew::program {
namespace {

// How a node depends on its operands: d node = sum of partial[k] * d operand[k].
struct Partials {
  std::array<Ref, 3> operand;
  std::array<Ref, 3> partial;
  int count = 0;

  void add(Ref operand_ref, Ref partial_ref) {
    operand[static_cast<std::size_t>(count)] = operand_ref;
    partial[static_cast<std::size_t>(count)] = partial_ref;
    ++count;
  }
};

// Makes the nodes that the partial derivatives need.
Partials partials_of(Dag& dag, std::uint32_t index) {
  const Node node = dag.node(index);  // a copy: making nodes may move the graph
  const Ref self = Ref::of(index);
  const Ref one = dag.constant(1.0);
  Partials partials;
  switch (node.op) {
    case Op::kAdd:
      partials.add(node.a, one);
      partials.add(node.b, one);
      break;
    case Op::kMultiply:
      partials.add(node.a, node.b);
      partials.add(node.b, node.a);
      break;
    case Op::kFma:
      partials.add(node.a, node.b);
      partials.add(node.b, node.a);
      partials.add(node.c, one);
      break;
    case Op::kDivide: {
      const Ref inverse = dag.divide(one, node.b);
      partials.add(node.a, inverse);
      partials.add(node.b, -dag.multiply(self, inverse));
      break;
    }
    case Op::kSqrt:
      partials.add(node.a, dag.divide(dag.constant(0.5), self));
      break;
    case Op::kSin:
      partials.add(node.a, dag.cos(node.a));
      break;
    case Op::kCos:
      partials.add(node.a, -dag.sin(node.a));
      break;
    case Op::kSelect: {
      const Ref zero = dag.constant(0.0);
      partials.add(node.b, dag.select(node.a, one, zero));
      partials.add(node.c, dag.select(node.a, zero, one));
      break;
    }
    case Op::kConstant:
    case Op::kInput:
    case Op::kLess:  // constant but for its step
      break;
  }
  return partials;
}

using Matrix = std::vector<Ref>;

struct Task {
  std::span<const std::uint32_t> rows, columns;
  std::uint32_t original_nodes;  // nodes of the value; those of the derivative come after
  const std::vector<std::uint8_t>& needed;  // nodes that some row depends on
};

// One tangent for each column, from the inputs to the results.
Matrix forward(Computation& computation, const Task& task) {
  Dag& dag = computation.dag;
  const Ref zero = dag.constant(0.0);
  Matrix matrix(task.rows.size() * task.columns.size(), zero);
  std::vector<Partials> partials(task.original_nodes);
  for (std::uint32_t i = 0; i < task.original_nodes; ++i) {
    if (task.needed[i]) partials[i] = partials_of(dag, i);
  }
  std::vector<Ref> tangent(task.original_nodes);
  const auto of = [&](Ref ref) { return tangent[ref.node()].negated_if(ref.negative()); };
  for (std::size_t j = 0; j < task.columns.size(); ++j) {
    for (std::uint32_t i = 0; i < task.original_nodes; ++i) {
      tangent[i] = zero;
      if (!task.needed[i]) continue;
      const Node& node = dag.node(i);
      if (node.op == Op::kInput && node.index == task.columns[j]) tangent[i] = dag.constant(1.0);
      for (int k = 0; k < partials[i].count; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const Ref term = dag.multiply(partials[i].partial[at], of(partials[i].operand[at]));
        tangent[i] = dag.add(tangent[i], term);
      }
    }
    for (std::size_t r = 0; r < task.rows.size(); ++r) {
      matrix[r * task.columns.size() + j] = of(computation.results[task.rows[r]]);
    }
  }
  return matrix;
}

// One adjoint for each row, from the result to the inputs.
Matrix reverse(Computation& computation, const Task& task) {
  Dag& dag = computation.dag;
  const Ref zero = dag.constant(0.0);
  Matrix matrix(task.rows.size() * task.columns.size(), zero);
  std::vector<Partials> partials(task.original_nodes);
  std::vector<std::uint32_t> input_node;
  for (std::uint32_t i = 0; i < task.original_nodes; ++i) {
    if (!task.needed[i]) continue;
    partials[i] = partials_of(dag, i);
    if (dag.node(i).op != Op::kInput) continue;
    const std::uint32_t index = dag.node(i).index;
    if (index >= input_node.size()) input_node.resize(index + 1, kNoOrigin);
    input_node[index] = i;
  }
  std::vector<Ref> adjoint(task.original_nodes);
  for (std::size_t r = 0; r < task.rows.size(); ++r) {
    adjoint.assign(task.original_nodes, zero);
    const Ref result = computation.results[task.rows[r]];
    adjoint[result.node()] = dag.constant(1.0).negated_if(result.negative());
    for (std::uint32_t i = task.original_nodes; i-- > 0;) {
      if (adjoint[i] == zero) continue;
      for (int k = 0; k < partials[i].count; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const Ref operand = partials[i].operand[at];
        const Ref term = dag.multiply(adjoint[i], partials[i].partial[at]);
        Ref& sum = adjoint[operand.node()];
        sum = dag.add(sum, term.negated_if(operand.negative()));
      }
    }
    for (std::size_t j = 0; j < task.columns.size(); ++j) {
      const std::uint32_t column = task.columns[j];
      const bool used = column < input_node.size() && input_node[column] != kNoOrigin;
      if (used) matrix[r * task.columns.size() + j] = adjoint[input_node[column]];
    }
  }
  return matrix;
}

void check_index(std::uint32_t index, std::size_t size, const char* what) {
  if (index < size) return;
  throw Error({{},
               "",
               std::string("there is no ") + what + " " + std::to_string(index),
               "choose one below " + std::to_string(size),
               Severity::kError,
               {}});
}

}  // namespace

Computation differentiate(const Computation& computation, std::span<const std::uint32_t> rows,
                          std::span<const std::uint32_t> columns, bool keep_values,
                          DerivativeMode mode) {
  for (const std::uint32_t row : rows) check_index(row, computation.results.size(), "result");
  for (const std::uint32_t column : columns) check_index(column, computation.inputs, "input");

  if (mode == DerivativeMode::kCheaper) {
    Computation by_inputs =
        differentiate(computation, rows, columns, keep_values, DerivativeMode::kForward);
    Computation by_results =
        differentiate(computation, rows, columns, keep_values, DerivativeMode::kReverse);
    const auto cost = [](const Computation& c) {
      const OperationCount count = count_operations(c);
      return count.add + count.multiply + 4 * (count.divide + count.sqrt);
    };
    return cost(by_results) < cost(by_inputs) ? by_results : by_inputs;
  }

  Computation wanted = computation;
  wanted.order.clear();
  wanted.results.clear();
  for (const std::uint32_t row : rows) wanted.results.push_back(computation.results[row]);
  const std::vector<std::uint8_t> needed = live_nodes(wanted);

  Computation derivative = computation;
  derivative.order.clear();
  const Task task{rows, columns, computation.dag.size(), needed};
  Matrix matrix =
      mode == DerivativeMode::kForward ? forward(derivative, task) : reverse(derivative, task);
  if (!keep_values) derivative.results.clear();
  derivative.results.insert(derivative.results.end(), matrix.begin(), matrix.end());
  return derivative;
}

}  // namespace sinew::program
