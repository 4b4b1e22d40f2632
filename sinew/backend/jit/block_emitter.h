// The function of a block with its registers planned (register_plan.h), for machines that have 32
// of them, as wide as a block, and read one number from memory for all lanes.
//
// A store costs such a processor more than a multiplication, while what lies in memory is an
// operand for nothing: so as little is written as possible. Inputs stay where they are and are read
// again, the order keeps few values alive (block_order.h), and what lies in memory is held longer.
#pragma once

#include <cstdint>
#include <memory>

#include "sinew/backend/jit/place.h"
#include "sinew/program/dag/dag.h"

namespace sinew::backend {

class PlannedBlock {
 public:
  // As many samples as `type` has lanes, so many values in registers. Writes nothing yet.
  PlannedBlock(const program::Computation& computation, const Place& place, LLVMTypeRef type,
               std::uint32_t registers);
  ~PlannedBlock();
  PlannedBlock(const PlannedBlock&) = delete;
  PlannedBlock& operator=(const PlannedBlock&) = delete;

  bool is_short() const;  // few operations, few values that wait in memory
  void emit();            // the whole function

 private:
  class Emitter;
  std::unique_ptr<Emitter> emitter_;
};

}  // namespace sinew::backend
