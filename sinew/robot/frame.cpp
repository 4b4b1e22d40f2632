#include "sinew/robot/frame.h"

#include <bit>
#include <cstring>

#include "sinew/runtime/crc32.h"

namespace sinew::robot {
namespace {

static_assert(std::endian::native == std::endian::little,
              "frames are copied as they lie in memory");

constexpr char kMagic[] = {'S', 'N', 'W', 'F'};
constexpr std::uint8_t kVersion = 1;

template <typename T>
void put(std::span<std::byte> bytes, std::size_t at, const T& value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}
template <typename T>
T get(std::span<const std::byte> bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

}  // namespace

std::size_t encode(const Frame& frame, std::span<const double> numbers,
                   std::span<std::byte> bytes) noexcept {
  const std::size_t size = kFrameOverhead + 8 * numbers.size();
  if (numbers.size() > kMaximumNumbers || bytes.size() < size) return 0;
  std::memcpy(bytes.data(), kMagic, sizeof kMagic);
  put(bytes, 4, kVersion);
  put(bytes, 5, static_cast<std::uint8_t>(frame.kind));
  put(bytes, 6, static_cast<std::uint16_t>(numbers.size()));
  put(bytes, 8, frame.layout);
  put(bytes, 12, frame.sequence);
  put(bytes, 16, frame.time_ns);
  if (!numbers.empty()) std::memcpy(bytes.data() + 24, numbers.data(), 8 * numbers.size());
  put(bytes, size - 4, runtime::crc32(bytes.first(size - 4)));
  return size;
}

std::optional<Frame> decode(std::span<const std::byte> bytes, std::span<double> numbers) noexcept {
  if (bytes.size() < kFrameOverhead || bytes.size() > kMaximumFrame) return std::nullopt;
  if (std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0) return std::nullopt;
  if (get<std::uint8_t>(bytes, 4) != kVersion) return std::nullopt;
  const auto kind = get<std::uint8_t>(bytes, 5);
  const std::size_t count = get<std::uint16_t>(bytes, 6);
  if ((kind != 1 && kind != 2) || count > numbers.size() ||
      bytes.size() != kFrameOverhead + 8 * count)
    return std::nullopt;
  if (get<std::uint32_t>(bytes, bytes.size() - 4) != runtime::crc32(bytes.first(bytes.size() - 4)))
    return std::nullopt;
  if (count > 0) std::memcpy(numbers.data(), bytes.data() + 24, 8 * count);
  return Frame{static_cast<FrameKind>(kind), get<std::uint32_t>(bytes, 8),
               get<std::uint32_t>(bytes, 12), get<std::uint64_t>(bytes, 16), count};
}

std::uint32_t layout_of(const std::vector<std::string>& channels) {
  std::string text;
  for (const std::string& channel : channels) text += channel + "\n";
  return runtime::crc32(std::as_bytes(std::span(text)));
}

}  // namespace sinew::robot
