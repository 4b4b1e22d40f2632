// Name-based UUIDs (RFC 4122 section 4.3, version 5): the same name always gives the same UUID.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sinew::graph {

using Sha1Digest = std::array<std::uint8_t, 20>;
// FIPS 180-4. Used for naming only, not for security. By the processor's instructions for it where
// it has them.
Sha1Digest sha1(std::string_view message);
Sha1Digest sha1_portable(std::string_view message);

// The same of a message that comes in pieces: several that begin alike share that work.
class Sha1 {
 public:
  void add(std::string_view piece);
  Sha1Digest digest() const;  // of what was added so far

 private:
  std::array<std::uint32_t, 5> state_ = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476,
                                         0xc3d2e1f0};
  std::uint64_t size_ = 0;                   // of the message
  std::array<std::uint8_t, 64> begun_ = {};  // its last bytes, which fill no block yet
};

using Uuid = std::array<std::uint8_t, 16>;
Uuid name_based_uuid(const Uuid& name_space, std::string_view name);
// The same where the digest is that of the namespace's bytes and the name.
Uuid name_based_uuid(const Sha1Digest& digest);
// 8-4-4-4-12 lower-case hexadecimal digits.
std::string to_string(const Uuid& uuid);
inline constexpr std::size_t kUuidText = 36;
void write_text(const Uuid& uuid, char* to);  // kUuidText characters

}  // namespace sinew::graph
