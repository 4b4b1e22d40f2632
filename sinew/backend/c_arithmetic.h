// C expressions of the operations that scalars and vectors have in common; internal to `backend`.
#pragma once

#include <string>

#include "sinew/program/dag/dag.h"

namespace sinew::backend {

inline bool is_arithmetic(program::Op op) {
  return op == program::Op::kAdd || op == program::Op::kMultiply || op == program::Op::kFma ||
         op == program::Op::kDivide;
}

// Appends the sum, product, both at once, or quotient; `value` gives the text that a node stands
// for, and may write statements before this one: those of the last operand first. When they are
// there, `begin` writes what stands in front of the expression.
template <typename Value, typename Begin>
void append_arithmetic(std::string& text, const program::Node& node, Value value, Begin begin) {
  const bool fused = node.op == program::Op::kFma;
  const std::string* const c = fused ? &value(node.c.node()) : nullptr;
  const std::string& b = value(node.b.node());
  const std::string& a = value(node.a.node());
  begin();
  const auto plus = [&](program::Ref term, const std::string& name) {
    text += term.negative() ? " - " : " + ";
    text += name;
  };
  if (node.op == program::Op::kAdd) {
    if (node.a.negative()) text += '-';
    text += a;
    return plus(node.b, b);
  }
  // The sign of a product belongs to all of it: compilers take it into a fused operation, but a
  // negative factor that several of them read is computed on its own.
  const bool negative = node.a.negative() != node.b.negative();
  const bool subtracted = fused && negative && !node.c.negative();
  if (subtracted) {
    text += *c;
    text += " - ";
  } else if (negative) {
    text += "-(";
  }
  text += a;
  text += node.op == program::Op::kDivide ? " / " : " * ";
  text += b;
  if (negative && !subtracted) text += ')';
  if (fused && !subtracted) plus(node.c, *c);
}

}  // namespace sinew::backend
