// The one file that uses libcrypto, which is loaded when the first digest is asked for.
#include "sinew/rdf/sparql/values/digest.h"

#include <dlfcn.h>
#include <openssl/evp.h>

#include <array>
#include <utility>

#include "sinew/base/error.h"

namespace sinew::rdf::sparql::values {
namespace {

[[noreturn]] void fail(std::string what, std::string remedy) {
  throw Error(Problem{{}, {}, std::move(what), std::move(remedy), Severity::kError, {}});
}

struct Crypto {
  decltype(&EVP_Q_digest) digest = nullptr;
  std::string missing;  // why there is none
};

Crypto load() {
  Crypto crypto;
  // Kept for the life of the process.
  void* const library = dlopen(SINEW_CRYPTO_NAME, RTLD_LAZY | RTLD_LOCAL);
  void* const function = library != nullptr ? dlsym(library, "EVP_Q_digest") : nullptr;
  if (function == nullptr) crypto.missing = dlerror();
  crypto.digest = reinterpret_cast<decltype(&EVP_Q_digest)>(function);
  return crypto;
}

}  // namespace

std::string digest(std::string_view text, DigestKind kind) {
  static constexpr const char* kNames[] = {"MD5", "SHA1", "SHA256", "SHA384", "SHA512"};
  const char* const name = kNames[static_cast<int>(kind)];
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
  std::size_t size = 0;
  static const Crypto crypto = load();
  if (crypto.digest == nullptr)
    fail(std::string(name) + " is not computed: " + crypto.missing,
         "install OpenSSL (Debian's libssl3)");
  if (crypto.digest(nullptr, name, nullptr, text.data(), text.size(), bytes.data(), &size) != 1)
    fail(std::string("libcrypto refuses to compute ") + name,
         "allow it in the configuration of OpenSSL, or use SHA256");
  static constexpr char kHex[] = "0123456789abcdef";
  std::string result;
  for (std::size_t i = 0; i < size; ++i) {
    result.append(1, kHex[bytes[i] >> 4]).append(1, kHex[bytes[i] & 15]);
  }
  return result;
}

}  // namespace sinew::rdf::sparql::values
