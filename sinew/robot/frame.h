// What goes over the wire between Sinew and the bridge to a robot: one datagram, one frame.
//
// Little-endian, no padding:
//    0  4  "SNWF"
//    4  1  version, 1
//    5  1  kind: 1 measurement, 2 command
//    6  2  count n of numbers
//    8  4  layout: CRC-32 of the channels' names, each followed by a line feed
//   12  4  sequence, one more each frame, wraps around
//   16  8  the sender's clock [ns]; only told, never compared with one's own
//   24  8n IEEE 754 doubles, SI units
//   24+8n 4 CRC-32 of everything before
//
// A measurement holds the positions, then the velocities of all joints in the model's order; a
// command the joint forces. Anything else is no frame and is ignored as a whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sinew::robot {

inline constexpr std::size_t kMaximumNumbers = 256;
inline constexpr std::size_t kFrameOverhead = 28;
inline constexpr std::size_t kMaximumFrame = kFrameOverhead + 8 * kMaximumNumbers;  // bytes

enum class FrameKind : std::uint8_t { kMeasurement = 1, kCommand = 2 };

struct Frame {
  FrameKind kind = FrameKind::kMeasurement;
  std::uint32_t layout = 0;
  std::uint32_t sequence = 0;
  std::uint64_t time_ns = 0;
  std::size_t count = 0;  // of numbers
};

// Both allocate nothing and read or write nothing outside the spans.

// The frame's bytes; 0: `bytes` is too small or there are too many numbers.
std::size_t encode(const Frame& frame, std::span<const double> numbers,
                   std::span<std::byte> bytes) noexcept;
// `numbers` gets the first frame.count; nothing when the bytes are no frame or hold more numbers
// than there is room for.
std::optional<Frame> decode(std::span<const std::byte> bytes, std::span<double> numbers) noexcept;

std::uint32_t layout_of(const std::vector<std::string>& channels);

// Whether `a` comes after `b`, the counter's wrapping allowed for.
inline bool is_after(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::int32_t>(a - b) > 0;
}

}  // namespace sinew::robot
