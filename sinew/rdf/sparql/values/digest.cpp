// The one file that uses libcrypto.
#include "sinew/rdf/sparql/values/digest.h"

#include <openssl/evp.h>

#include <array>

#include "sinew/base/error.h"

namespace sinew::rdf::sparql::values {

std::string digest(std::string_view text, DigestKind kind) {
  static constexpr const char* kNames[] = {"MD5", "SHA1", "SHA256", "SHA384", "SHA512"};
  const char* const name = kNames[static_cast<int>(kind)];
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
  std::size_t size = 0;
  if (EVP_Q_digest(nullptr, name, nullptr, text.data(), text.size(), bytes.data(), &size) != 1) {
    throw Error(Problem{{},
                        {},
                        std::string("libcrypto refuses to compute ") + name,
                        "allow it in the configuration of OpenSSL, or use SHA256",
                        Severity::kError,
                        {}});
  }
  static constexpr char kHex[] = "0123456789abcdef";
  std::string result;
  for (std::size_t i = 0; i < size; ++i) {
    result.append(1, kHex[bytes[i] >> 4]).append(1, kHex[bytes[i] & 15]);
  }
  return result;
}

}  // namespace sinew::rdf::sparql::values
