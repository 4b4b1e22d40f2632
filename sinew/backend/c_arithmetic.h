// C expressions of the operations that scalars and vectors have in common; internal to `backend`.
#pragma once

#include <string>

#include "sinew/program/dag/dag.h"

namespace sinew::backend {

// Appends the sum, product, both at once, or quotient; `value` gives the text that a node stands
// for, and may write statements before this one: those of the last operand first.
template <typename Value>
void append_arithmetic(std::string& text, const program::Node& node, Value value) {
  const bool fused = node.op == program::Op::kFma;
  const std::string* const c = fused ? &value(node.c.node()) : nullptr;
  const std::string& b = value(node.b.node());
  const std::string& a = value(node.a.node());
  if (node.a.negative()) text += '-';
  text += a;
  const auto plus = [&](program::Ref term, const std::string& name) {
    text += term.negative() ? " - " : " + ";
    text += name;
  };
  if (node.op == program::Op::kAdd) return plus(node.b, b);
  text += node.op == program::Op::kDivide ? " / " : " * ";
  if (node.b.negative()) text += '-';
  text += b;
  if (fused) plus(node.c, *c);
}

}  // namespace sinew::backend
