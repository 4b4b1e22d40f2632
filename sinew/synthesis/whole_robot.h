// What the steps share that look at a robot as a whole: quantities seen from the root, and matrices
// with a column for each joint's velocity.
#pragma once

#include "sinew/synthesis/context.h"

namespace sinew::synthesis {

// A quantity of the whole robot, seen from the root and about its origin.
algorithm::BlockSpec whole(const Context& context, std::string_view slot,
                           std::string_view quantity);

// Of all that moves, and the root, seen from the root; after the step total-inertia.
BlockIndex total_inertia(Context& context);

// A step that looks at the root alone, when the inward sweep has reached it.
Step at_root(std::string name, std::string purpose, std::vector<std::string> needs,
             std::string gives, Pass configure, Pass compute);

// A matrix that has a column for each joint's velocity, and six for a floating base's.
struct ColumnsOfJoints {
  std::string_view column, matrix;  // slots
  std::string_view column_quantity, block_quantity, matrix_quantity;
  std::uint32_t rows = 6;
  // Operators: for the joint's kind is appended; and what puts the columns together.
  std::string_view column_operator, columns_operator, assemble, assemble_floating;
};

// `spec` is what columns and matrix have in common: of, with respect to, seen by, reference.
void configure_columns(Context& context, const ColumnsOfJoints& matrix,
                       const algorithm::BlockSpec& common);
// Each column from the joint's pose, the inertia that the joint moves, and one more block.
void compute_columns(Context& context, const ColumnsOfJoints& matrix, BlockIndex other);

}  // namespace sinew::synthesis
