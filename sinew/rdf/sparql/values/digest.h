// Digests of texts, as SPARQL's MD5, SHA1, ... give them.
#pragma once

#include <string>
#include <string_view>

namespace sinew::rdf::sparql::values {

enum class DigestKind { kMd5, kSha1, kSha256, kSha384, kSha512 };

// In hexadecimal, small letters.
std::string digest(std::string_view text, DigestKind kind);

}  // namespace sinew::rdf::sparql::values
