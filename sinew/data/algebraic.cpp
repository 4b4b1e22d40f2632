#include "sinew/data/algebraic.h"

#include <fmt/format.h>

namespace sinew::data {

std::string to_string(const Algebraic& algebraic) {
  switch (algebraic.kind) {
    case Algebraic::Kind::kScalar:
      return fmt::format("Scalar{{{}}}", fmt::join(algebraic.names, ","));
    case Algebraic::Kind::kVector:
      return fmt::format("Vector{{{}}}", algebraic.rows);
    case Algebraic::Kind::kMatrix:
      return fmt::format("Matrix{{{},{}}}", algebraic.rows, algebraic.columns);
  }
  return {};
}

Accessor accessor_of(const Algebraic& algebraic, std::size_t element) {
  switch (algebraic.kind) {
    case Algebraic::Kind::kScalar:
      return {false, {algebraic.names[element]}};
    case Algebraic::Kind::kVector:
      return {false, {std::to_string(element)}};
    case Algebraic::Kind::kMatrix:
      break;
  }
  return {
      true,
      {std::to_string(element / algebraic.columns), std::to_string(element % algebraic.columns)}};
}

std::optional<std::size_t> element_of(const Algebraic& algebraic, const Accessor& accessor) {
  if (algebraic.kind == Algebraic::Kind::kScalar) {
    if (accessor.braces || accessor.steps.size() != 1) return std::nullopt;
    for (std::size_t i = 0; i < algebraic.names.size(); ++i) {
      if (algebraic.names[i] == accessor.steps[0]) return i;
    }
    return std::nullopt;
  }
  if (algebraic.kind == Algebraic::Kind::kVector) {
    if (accessor.steps.size() != 1) return std::nullopt;
    const auto index = index_of(accessor.steps[0]);
    return index && *index < algebraic.rows ? index : std::nullopt;
  }
  if (!accessor.braces || accessor.steps.size() != 2) return std::nullopt;
  const auto row = index_of(accessor.steps[0]), column = index_of(accessor.steps[1]);
  if (!row || !column || *row >= algebraic.rows || *column >= algebraic.columns)
    return std::nullopt;
  return *row * algebraic.columns + *column;
}

std::string describe_accessors(const Algebraic& algebraic) {
  switch (algebraic.kind) {
    case Algebraic::Kind::kScalar:
      return fmt::format("it has {}", fmt::join(algebraic.names, ", "));
    case Algebraic::Kind::kVector:
      return fmt::format("its indices are 0 to {}", algebraic.rows - 1);
    case Algebraic::Kind::kMatrix:
      break;
  }
  return fmt::format("write {{row,column}} with rows 0 to {} and columns 0 to {}",
                     algebraic.rows - 1, algebraic.columns - 1);
}

}  // namespace sinew::data
