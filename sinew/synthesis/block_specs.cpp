#include "sinew/synthesis/block_specs.h"

#include <stdexcept>
#include <string>

#include "sinew/algorithm/quantities.h"

namespace sinew::synthesis {

using algorithm::BlockSpec;

BlockSpec at_frame(std::string_view slot, std::string_view quantity, Id represents, Id of, Id frame,
                   Id wrt) {
  return {.slot = slot,
          .represents = represents,
          .quantity = quantity,
          .of = of,
          .wrt = wrt,
          .reference = frame,
          .seen_by = frame};
}

BlockSpec zero(BlockSpec spec) {
  static constexpr double kZeros[kMostZeros] = {};
  std::size_t size = spec.size;
  if (const algorithm::Quantity* quantity = algorithm::find_quantity(spec.quantity);
      quantity != nullptr && quantity->size > 0)
    size = quantity->size;
  if (size == 0 || size > kMostZeros)
    throw std::logic_error("a constant of zeros for " + std::string(spec.quantity) +
                           ", which has " + std::to_string(size) + " numbers");
  spec.role = algorithm::Role::kConstant;
  spec.value = std::span(kZeros).first(size);
  return spec;
}

}  // namespace sinew::synthesis
