// What is decided of a flat function before its statements are written, for one sample and for a
// block of samples alike; internal to `backend`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sinew/backend/angle_groups.h"
#include "sinew/backend/c_flat_body.h"
#include "sinew/backend/kept_values.h"

namespace sinew::backend {

struct FlatPlan {
  AngleGroups groups;
  // Results that are written with a node: the first of them, and the one after each; kNoSlot: none.
  std::vector<std::uint32_t> result_of, next_result;
  std::vector<std::uint32_t> later;  // results that are written at the end
  KeptValues kept;                   // empty where no value waits in memory
};

FlatPlan plan_flat(const program::Computation& computation, const FlatLayout& layout, FlatForm form,
                   std::size_t maximum_statements);

}  // namespace sinew::backend
