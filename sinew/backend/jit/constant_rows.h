// Results of a block that are constants: runs of rows with the same number are written by loops.
#pragma once

#include <optional>
#include <vector>

#include "sinew/backend/jit/place.h"
#include "sinew/backend/jit/row_addresses.h"

namespace sinew::backend {

// `results`: of each row its number, if it is a constant. `type`: a vector of numbers.
void store_constant_rows(const Place& place, LLVMTypeRef type, LLVMValueRef out,
                         const RowDistances& distances,
                         const std::vector<std::optional<double>>& results);

}  // namespace sinew::backend
