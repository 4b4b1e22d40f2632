// Formulas of a domain: how the numbers of one kind of coordinates follow from those of another.
//
//   let s = sin(phi);
//   X = r * cos(phi);  Y = r * s;  Z = Z
//
// Names on the right are the inputs' and those of earlier `let`s; every output is given once.
// Operators
// + - * / < > <= >= and unary -, the functions of scalar_graph.h, select(condition, then,
// otherwise), and pi.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/data/scalar_graph.h"

namespace sinew::data {

// How deep an expression may be nested.
constexpr std::size_t kMaximumFormulaDepth = 64;

struct Formula {
  ScalarGraph graph;                       // input i is the i-th name of `inputs`
  std::vector<ScalarGraph::Node> outputs;  // in the order of `outputs`
};

// Throws Error with a place for unknown names, outputs that are missing or given twice, and bad
// syntax.
Formula parse_formula(std::string_view text, const Place& place,
                      std::span<const std::string> inputs, std::span<const std::string> outputs);

}  // namespace sinew::data
