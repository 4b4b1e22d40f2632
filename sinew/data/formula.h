// Formulas of a domain: how the numbers of one kind of coordinates follow from those of another.
//
//   let s = sin(phi);
//   X = r * cos(phi);  Y = r * s;  Z = Z
//
// Names on the right are the inputs' and those of earlier `let`s; every output is given once.
// Operators
// + - * / < > <= >= and unary -, the functions of scalar_graph.h, select(condition, then,
// otherwise), and pi.
//
// Dimensions are checked: what is added, compared or chosen between has the same one, sine and its
// kin take a pure number, a square root's exponents are halved, and every result has the dimension
// of its parameter. Angles count as pure numbers here, as in the SI, so that w x r is a velocity;
// the number 0 is of every dimension.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/data/dimension.h"
#include "sinew/data/scalar_graph.h"

namespace sinew::data {

// How deep an expression may be nested.
constexpr std::size_t kMaximumFormulaDepth = 64;

// A number that goes in or comes out; without a dimension it is not checked.
struct FormulaParameter {
  std::string name;
  std::optional<Dimension> dimension;
};

struct Formula {
  ScalarGraph graph;                       // input i is the i-th name of `inputs`
  std::vector<ScalarGraph::Node> outputs;  // in the order of `outputs`
};

// Throws Error with a place for unknown names, outputs that are missing or given twice, dimensions
// that do not fit, and bad syntax.
Formula parse_formula(std::string_view text, const Place& place,
                      std::span<const FormulaParameter> inputs,
                      std::span<const FormulaParameter> outputs);

}  // namespace sinew::data
