// Algebraic forms: the abstract shape in which the numbers of a value are spoken of, free of
// memory.
//   Scalar{x,y,z,w}   numbers by name      Vector{3}   by index      Matrix{4,4}   by row and
//   column
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/data/accessor.h"

namespace sinew::data {

// The most elements of a form.
constexpr std::size_t kMaximumElements = 4096;

struct Algebraic {
  enum class Kind : std::uint8_t { kScalar, kVector, kMatrix };
  Kind kind = Kind::kScalar;
  std::vector<std::string> names;     // of a Scalar
  std::size_t rows = 0, columns = 1;  // of a Vector and a Matrix

  std::size_t size() const { return kind == Kind::kScalar ? names.size() : rows * columns; }
  friend bool operator==(const Algebraic&, const Algebraic&) = default;
};

std::string to_string(const Algebraic& algebraic);  // "Matrix{3,3}"
// Elements are numbered in the order of the names, or row by row.
Accessor accessor_of(const Algebraic& algebraic, std::size_t element);
std::optional<std::size_t> element_of(const Algebraic& algebraic, const Accessor& accessor);
// How a wrong accessor could have been meant: "it has X, Y, Z", "rows 0 to 2, columns 0 to 2".
std::string describe_accessors(const Algebraic& algebraic);

}  // namespace sinew::data
