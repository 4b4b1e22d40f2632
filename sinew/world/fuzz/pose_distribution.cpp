// Whatever numbers come, they are a distribution of a pose or they are refused; and what was read
// is written and read as the same.
#include "sinew/world/pose_distribution.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<double> numbers(size / sizeof(double));
  if (!numbers.empty()) std::memcpy(numbers.data(), data, numbers.size() * sizeof(double));
  const auto found = sinew::world::from_numbers(numbers);
  if (!found) return 0;
  if (sinew::world::fault_of(*found)) std::abort();
  const auto again = sinew::world::from_numbers(sinew::world::to_numbers(*found, numbers.size()));
  if (!again || again->index() != found->index()) std::abort();
  return 0;
}
