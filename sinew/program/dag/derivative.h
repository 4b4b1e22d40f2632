// Analytic derivatives: the data-flow graph of a Jacobian from the data-flow graph of the function,
// by the chain rule on its operations (Griewank & Walther, Evaluating Derivatives, 2008, chapters 3
// and 4).
//
// Forward mode carries one tangent for each input, reverse mode one adjoint for each result; both
// give the same numbers at different cost. What does not depend on an input is the constant 0, so a
// sparse Jacobian costs what its entries cost. The value itself shares its nodes with the
// derivative.
//
// A selection is differentiated branch by branch; at the switching point the derivative is that of
// the branch that is taken there.
#pragma once

#include <cstdint>
#include <span>

#include "sinew/program/dag/dag.h"

namespace sinew::program {

enum class DerivativeMode : std::uint8_t { kForward, kReverse, kCheaper };

// A computation with the same inputs whose results are d results[rows[i]] / d inputs[columns[j]],
// row after row. With `keep_values` the original results come first. kCheaper: whichever needs
// fewer additions and multiplications. Throws Error for a row or a column that is not there.
Computation differentiate(const Computation& computation, std::span<const std::uint32_t> rows,
                          std::span<const std::uint32_t> columns, bool keep_values = false,
                          DerivativeMode mode = DerivativeMode::kCheaper);

}  // namespace sinew::program
