// Name-based UUIDs (RFC 4122 section 4.3, version 5): the same name always gives the same UUID.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace sinew::graph {

using Sha1Digest = std::array<std::uint8_t, 20>;
// FIPS 180-4. Used for naming only, not for security. By the processor's instructions for it where
// it has them.
Sha1Digest sha1(std::string_view message);
Sha1Digest sha1_portable(std::string_view message);

using Uuid = std::array<std::uint8_t, 16>;
Uuid name_based_uuid(const Uuid& name_space, std::string_view name);
// 8-4-4-4-12 lower-case hexadecimal digits.
std::string to_string(const Uuid& uuid);

}  // namespace sinew::graph
