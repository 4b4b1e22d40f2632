#include "sinew/graph/uuid.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>

#if defined(__x86_64__)
#include <cpuid.h>
#include <immintrin.h>
#endif

namespace sinew::graph {
namespace {

// One block of FIPS 180-4, section 6.1.2.
void absorb(std::array<std::uint32_t, 5>& state, const std::uint8_t* block) {
  std::array<std::uint32_t, 80> w;
  for (std::size_t t = 0; t < 16; ++t) {
    w[t] = std::uint32_t{block[4 * t]} << 24 | std::uint32_t{block[4 * t + 1]} << 16 |
           std::uint32_t{block[4 * t + 2]} << 8 | block[4 * t + 3];
  }
  for (std::size_t t = 16; t < 80; ++t) {
    w[t] = std::rotl(w[t - 3] ^ w[t - 8] ^ w[t - 14] ^ w[t - 16], 1);
  }
  auto [a, b, c, d, e] = state;
  for (std::size_t t = 0; t < 80; ++t) {
    std::uint32_t f, k;
    if (t < 20) {
      f = (b & c) ^ (~b & d), k = 0x5a827999;
    } else if (t < 40) {
      f = b ^ c ^ d, k = 0x6ed9eba1;
    } else if (t < 60) {
      f = (b & c) ^ (b & d) ^ (c & d), k = 0x8f1bbcdc;
    } else {
      f = b ^ c ^ d, k = 0xca62c1d6;
    }
    const std::uint32_t next = std::rotl(a, 5) + f + e + k + w[t];
    e = d, d = c, c = std::rotl(b, 30), b = a, a = next;
  }
  state[0] += a, state[1] += b, state[2] += c, state[3] += d, state[4] += e;
}

#if defined(__x86_64__)
// The same by the processor's own instructions, a fifth of the time: four rounds at once. The words
// of a vector stand in reverse order.
__attribute__((target("sha,sse4.1"))) void absorb_by_processor(std::array<std::uint32_t, 5>& state,
                                                               const std::uint8_t* block) {
  const __m128i reverse = _mm_set_epi64x(0x0001020304050607, 0x08090a0b0c0d0e0f);
  __m128i w[20];
  for (std::size_t g = 0; g < 4; ++g) {
    __m128i words;
    std::memcpy(&words, block + 16 * g, sizeof words);
    w[g] = _mm_shuffle_epi8(words, reverse);
  }
  for (std::size_t g = 4; g < 20; ++g) {
    const __m128i older = _mm_xor_si128(_mm_sha1msg1_epu32(w[g - 4], w[g - 3]), w[g - 2]);
    w[g] = _mm_sha1msg2_epu32(older, w[g - 1]);
  }
  __m128i abcd;
  std::memcpy(&abcd, state.data(), sizeof abcd);
  abcd = _mm_shuffle_epi32(abcd, 0x1b);
  const __m128i abcd_before = abcd;
  const __m128i e_before = _mm_set_epi32(static_cast<int>(state[4]), 0, 0, 0);
  __m128i e = _mm_add_epi32(e_before, w[0]);
  for (std::size_t g = 0; g < 20; ++g) {
    const __m128i previous = abcd;
    switch (g / 5) {  // the function of the rounds is part of the instruction
      case 0:
        abcd = _mm_sha1rnds4_epu32(abcd, e, 0);
        break;
      case 1:
        abcd = _mm_sha1rnds4_epu32(abcd, e, 1);
        break;
      case 2:
        abcd = _mm_sha1rnds4_epu32(abcd, e, 2);
        break;
      default:
        abcd = _mm_sha1rnds4_epu32(abcd, e, 3);
    }
    e = _mm_sha1nexte_epu32(previous, g < 19 ? w[g + 1] : e_before);
  }
  abcd = _mm_shuffle_epi32(_mm_add_epi32(abcd, abcd_before), 0x1b);
  std::memcpy(state.data(), &abcd, sizeof abcd);
  state[4] = static_cast<std::uint32_t>(_mm_extract_epi32(e, 3));
}

bool processor_has_sha() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  if (__get_cpuid(1, &a, &b, &c, &d) == 0 || (c & bit_SSE4_1) == 0) return false;
  constexpr unsigned kSha = 1U << 29U;  // leaf 7, EBX
  return __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b & kSha) != 0;
}
#endif

using Absorb = void (*)(std::array<std::uint32_t, 5>&, const std::uint8_t*);

Absorb fastest_absorb() {
#if defined(__x86_64__)
  if (processor_has_sha()) return absorb_by_processor;
#endif
  return absorb;
}

// `last`: those bytes of a message of this size that fill no block.
Sha1Digest finished(Absorb absorb_block, std::array<std::uint32_t, 5> state,
                    const std::uint8_t* last, std::uint64_t message_size) {
  // Padding: one bit, zeros, and the length in bits in the last 8 bytes.
  std::array<std::uint8_t, 128> tail = {};
  const std::size_t left = message_size % 64;
  if (left > 0) std::memcpy(tail.data(), last, left);
  tail[left] = 0x80;
  const std::size_t size = left < 56 ? 64 : 128;
  const std::uint64_t bits = message_size * 8;
  for (std::size_t i = 0; i < 8; ++i) {
    tail[size - 1 - i] = static_cast<std::uint8_t>(bits >> (8 * i));
  }
  for (std::size_t at = 0; at < size; at += 64) absorb_block(state, tail.data() + at);

  Sha1Digest digest;
  for (std::size_t i = 0; i < digest.size(); ++i) {
    digest[i] = static_cast<std::uint8_t>(state[i / 4] >> (24 - 8 * (i % 4)));
  }
  return digest;
}

Sha1Digest sha1_by(Absorb absorb_block, std::string_view message) {
  std::array<std::uint32_t, 5> state = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476, 0xc3d2e1f0};
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(message.data());
  std::size_t left = message.size();
  for (; left >= 64; left -= 64, bytes += 64) absorb_block(state, bytes);
  return finished(absorb_block, state, bytes, message.size());
}

}  // namespace

Sha1Digest sha1(std::string_view message) {
  static const Absorb fastest = fastest_absorb();
  return sha1_by(fastest, message);
}

Sha1Digest sha1_portable(std::string_view message) { return sha1_by(absorb, message); }

void Sha1::add(std::string_view piece) {
  static const Absorb fastest = fastest_absorb();
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(piece.data());
  std::size_t left = piece.size();
  const std::size_t begun = size_ % begun_.size();
  size_ += left;
  if (begun > 0) {
    const std::size_t more = std::min(left, begun_.size() - begun);
    std::copy_n(bytes, more, begun_.data() + begun);
    bytes += more;
    left -= more;
    if (begun + more < begun_.size()) return;
    fastest(state_, begun_.data());
  }
  for (; left >= begun_.size(); left -= begun_.size(), bytes += begun_.size())
    fastest(state_, bytes);
  std::copy_n(bytes, left, begun_.data());
}

Sha1Digest Sha1::digest() const {
  static const Absorb fastest = fastest_absorb();
  return finished(fastest, state_, begun_.data(), size_);
}

Uuid name_based_uuid(const Uuid& name_space, std::string_view name) {
  Sha1 hash;
  hash.add({reinterpret_cast<const char*>(name_space.data()), name_space.size()});
  hash.add(name);
  return name_based_uuid(hash.digest());
}

Uuid name_based_uuid(const Sha1Digest& digest) {
  Uuid uuid;
  std::copy_n(digest.begin(), uuid.size(), uuid.begin());
  uuid[6] = static_cast<std::uint8_t>((uuid[6] & 0x0f) | 0x50);  // version 5
  uuid[8] = static_cast<std::uint8_t>((uuid[8] & 0x3f) | 0x80);  // the variant of RFC 4122
  return uuid;
}

void write_text(const Uuid& uuid, char* to) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  for (std::size_t i = 0; i < uuid.size(); ++i) {
    if (i == 4 || i == 6 || i == 8 || i == 10) *to++ = '-';
    *to++ = kDigits[uuid[i] >> 4];
    *to++ = kDigits[uuid[i] & 15];
  }
}

std::string to_string(const Uuid& uuid) {
  std::string text(kUuidText, '\0');
  write_text(uuid, text.data());
  return text;
}

}  // namespace sinew::graph
