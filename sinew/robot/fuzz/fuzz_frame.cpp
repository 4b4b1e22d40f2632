// Any bytes from the wire: a frame that decodes encodes to the same bytes, everything else is
// refused. Half of the inputs get a right checksum, so that what lies behind it is reached.
#include <cstdlib>
#include <cstring>
#include <vector>

#include "sinew/robot/frame.h"
#include "sinew/runtime/crc32.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew::robot;
  if (size == 0) return 0;
  std::vector<std::byte> bytes(size - 1);
  if (size > 1) std::memcpy(bytes.data(), data + 1, size - 1);
  if ((data[0] & 1U) != 0 && bytes.size() >= 4) {
    const std::uint32_t crc = sinew::runtime::crc32(std::span(bytes).first(bytes.size() - 4));
    std::memcpy(bytes.data() + bytes.size() - 4, &crc, 4);
  }
  std::vector<double> numbers(data[0] >> 1U);
  const auto frame = decode(bytes, numbers);
  if (!frame) return 0;
  std::vector<std::byte> again(kMaximumFrame);
  const std::size_t written = encode(*frame, std::span(numbers).first(frame->count), again);
  if (written != bytes.size() || std::memcmp(again.data(), bytes.data(), written) != 0)
    std::abort();
  return 0;
}
