#include "sinew/graph/uuid.h"

#include <gtest/gtest.h>

#include <string>

namespace sinew::graph {
namespace {

std::string hex(const Sha1Digest& digest) {
  std::string text;
  for (const std::uint8_t byte : digest) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

TEST(Sha1, AgreesWithTheExamplesOfFips180) {
  EXPECT_EQ(hex(sha1("abc")), "a9993e364706816aba3e25717850c26c9cd0d89d");
  EXPECT_EQ(hex(sha1("")), "da39a3ee5e6b4b0d3255bfef95601890afd80709");
  EXPECT_EQ(hex(sha1("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq")),
            "84983e441c3bd26ebaae4aa1f95129e5e54670f1");
  EXPECT_EQ(hex(sha1(std::string(1'000'000, 'a'))), "34aa973cd4c4daa4f61eeb2bdbad27316534016f");
}

TEST(Sha1, IsTheSameByTheProcessorsInstructionsAndWithoutThem) {
  std::string message;
  for (int length = 0; length < 300; ++length) {
    EXPECT_EQ(hex(sha1(message)), hex(sha1_portable(message))) << length;
    message += static_cast<char>(length * 7 + 1);
  }
  EXPECT_EQ(hex(sha1_portable("abc")), "a9993e364706816aba3e25717850c26c9cd0d89d");
}

TEST(Sha1, IsTheSameOfAMessageThatComesInPieces) {
  std::string message;
  for (int k = 0; k < 300; ++k) message += static_cast<char>(k * 7 + 1);
  for (std::size_t piece = 1; piece < 200; piece += 3) {
    Sha1 hash;
    for (std::size_t at = 0; at < message.size(); at += piece) {
      EXPECT_EQ(hex(hash.digest()), hex(sha1(message.substr(0, at))));
      hash.add(std::string_view(message).substr(at, piece));
    }
    hash.add({});
    EXPECT_EQ(hex(hash.digest()), hex(sha1(message))) << piece;
  }
}

TEST(Uuid, AgreesWithTheExampleOfRfc9562) {
  // Appendix A.4: version 5 of "www.example.com" in the namespace of domain names.
  constexpr Uuid kDomains = {0x6b, 0xa7, 0xb8, 0x10, 0x9d, 0xad, 0x11, 0xd1,
                             0x80, 0xb4, 0x00, 0xc0, 0x4f, 0xd4, 0x30, 0xc8};
  EXPECT_EQ(to_string(name_based_uuid(kDomains, "www.example.com")),
            "2ed6657d-e927-568b-95e1-2665a8aea6a2");
}

}  // namespace
}  // namespace sinew::graph
