// What a query may cost at most. Each limit has its own error; none is silent.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace sinew::rdf::sparql {

// Deepest nesting of groups, parentheses, paths and collections in a text; bounds every recursion
// of the parser and of the stages behind it.
inline constexpr std::size_t kMaximumNesting = 200;
// Longest chain of operators that one solution passes through, and longest chain of OPTIONALs,
// MINUSes, BINDs and arithmetic operators; bounds the stack of the evaluator.
inline constexpr std::size_t kMaximumChain = 3000;
inline constexpr std::size_t kMaximumGroupChain = 1000;
// Most variables (blank nodes count) in one query; bounds the width of a solution.
inline constexpr std::size_t kMaximumVariables = 100'000;

struct Limits {
  std::size_t text_bytes = 64ull << 20;       // of a query or an update
  std::size_t nesting = kMaximumNesting;      // at most kMaximumNesting
  std::size_t rows = 10'000'000;              // solutions of a query, and of each table inside it
  std::size_t path_steps = 100'000'000;       // nodes reached by * and + in one evaluation
  std::size_t computed_bytes = 256ull << 20;  // of strings that one evaluation computes
  std::chrono::nanoseconds time{0};           // of one evaluation; 0: no limit
};

}  // namespace sinew::rdf::sparql
