// CRC-32 of IEEE 802.3, reflected, as zlib computes it: of log files and of frames on a wire.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace sinew::runtime {

std::uint32_t crc32(std::span<const std::byte> bytes) noexcept;

}  // namespace sinew::runtime
