// C expressions of the operations that scalars and vectors have in common; internal to `backend`.
#pragma once

#include <string>

#include "sinew/program/dag/dag.h"

namespace sinew::backend {

// `value` names what a Ref, or a node's index, stands for. Empty for other operations than sum,
// product, both at once, and quotient.
template <typename Value>
std::string c_arithmetic(const program::Node& node, Value value) {
  const auto plus = [&](program::Ref term) {
    return (term.negative() ? " - " : " + ") + value(term.node());
  };
  switch (node.op) {
    case program::Op::kAdd:
      return value(node.a) + plus(node.b);
    case program::Op::kMultiply:
      return value(node.a) + " * " + value(node.b);
    case program::Op::kFma:
      return value(node.a) + " * " + value(node.b) + plus(node.c);
    case program::Op::kDivide:
      return value(node.a) + " / " + value(node.b);
    default:
      return {};
  }
}

}  // namespace sinew::backend
