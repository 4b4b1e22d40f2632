// A function of one sample as a list of steps, for the plan of its registers and for what emits it.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "sinew/backend/jit/computation_emitter.h"
#include "sinew/backend/jit/register_plan.h"
#include "sinew/backend/jit/result_pairs.h"
#include "sinew/program/limbs/limb_program.h"

namespace sinew::backend {

// A node of a region.
struct RegionNode {
  std::uint32_t region = 0, node = 0;
};

// What an input of a region is made of.
enum class RegionInput : std::uint8_t {
  kCaller,    // a plain number of the caller's
  kConstant,  // in each lane
  kGathered   // from results of other regions, or lane by lane from the caller's numbers
};
RegionInput kind_of_input(const program::LimbRegion& region, std::uint32_t input);

class SampleSteps {
 public:
  // `emitters`: of the regions. `pairs`: are written when the later one is computed. `later`:
  // results that are written at the end, in a step of its own.
  SampleSteps(const program::LimbProgram& program, const std::vector<ComputationEmitter>& emitters,
              const std::vector<ResultPair>& pairs, const std::vector<std::uint32_t>& later);

  // The nodes in the order in which they are computed, gathered inputs among them.
  const std::vector<RegionNode>& nodes() const { return nodes_; }
  // As ValueSteps, with a step for each of nodes() and the last one, count their values.
  std::uint32_t value(std::uint32_t region, std::uint32_t node) const {
    return first_[region] + node;
  }
  RegionNode node_of(std::uint32_t value) const;
  const ValueSteps& registers() const { return registers_; }

 private:
  void add(std::uint32_t region, std::uint32_t node);
  void gather(std::uint32_t region, std::uint32_t node);
  void read_source(const program::LimbSource& source);
  void define(std::uint32_t region, std::uint32_t node);

  const program::LimbProgram& program_;
  const std::vector<ComputationEmitter>& emitters_;
  std::vector<std::uint32_t> first_;  // value of each region's first node; and behind the last
  std::vector<RegionNode> nodes_;
  std::vector<bool> defined_;                                        // values
  std::map<std::uint32_t, std::vector<std::uint32_t>> stored_with_;  // of a value: earlier ones
  ValueSteps registers_;
};

}  // namespace sinew::backend
