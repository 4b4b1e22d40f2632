// What a program with limbs computes and reads, step after step, for KeptValues; internal to
// `backend`.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/backend/kept_values.h"
#include "sinew/program/limbs/limb_program.h"

namespace sinew::backend {

// Nodes of all regions, numbered through.
class LimbNodes {
 public:
  explicit LimbNodes(const program::LimbProgram& program);

  std::uint32_t of(std::size_t region, std::uint32_t node) const { return first_[region] + node; }
  std::uint32_t size() const { return first_.back(); }

 private:
  std::vector<std::uint32_t> first_;
};

// The nodes of a region that have statements, in their order. `live`: of all nodes.
std::vector<std::uint32_t> limb_order(const program::LimbRegion& region,
                                      const std::vector<std::uint8_t>& live);

// One step for each of those nodes, region after region, with the inputs that it is the first to
// need; and one in which the results of `later` are written.
ValueSteps limb_steps(const program::LimbProgram& program, const LimbNodes& nodes,
                      const std::vector<std::vector<std::uint32_t>>& orders,
                      const std::vector<std::uint32_t>& later);

}  // namespace sinew::backend
