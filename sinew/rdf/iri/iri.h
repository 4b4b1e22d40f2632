// IRIs as text: taking them apart, and resolving references against a base (RFC 3986, section 5;
// RFC 3987 for the characters beyond ASCII, which need no treatment of their own here).
//
// Nothing here normalises beyond what resolving asks for (the removal of dot segments): two IRIs
// are the same term only if their characters are the same.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sinew::rdf {

// The five components of RFC 3986, section 3. A component that is absent is not the same as one
// that is empty: "x:" has no query, "x:?" has an empty one.
struct IriParts {
  std::optional<std::string_view> scheme;     // without the ':'
  std::optional<std::string_view> authority;  // without the "//"
  std::string_view path;
  std::optional<std::string_view> query;     // without the '?'
  std::optional<std::string_view> fragment;  // without the '#'
};

IriParts split_iri(std::string_view text);
std::string join_iri(const IriParts& parts);

// True when the text begins with a scheme, so that it means the same wherever it stands.
bool is_absolute_iri(std::string_view text);

// What `reference` means where `base` is the base IRI (RFC 3986, section 5.2, strict). The base
// must be absolute; if it is not, the reference comes back as it is when it is absolute, else
// nothing.
std::optional<std::string> resolve_iri(std::string_view reference, std::string_view base);

// The shortest of the usual forms that resolves to `iri` against `base`: a fragment, a query, a
// relative path, an absolute path; the IRI itself if none does.
std::string relative_iri(std::string_view iri, std::string_view base);

// What is wrong with the text as an absolute IRI, in words; nothing when it is one. Characters that
// no IRI may hold (RFC 3987, section 2.2: spaces, controls, <>"{}|\^`) and a missing scheme are
// faults.
std::optional<std::string> fault_of_iri(std::string_view text);

// A byte that may not stand in an IRI, whatever its position.
constexpr bool forbidden_in_iri(unsigned char byte) {
  return byte <= 0x20 || byte == '<' || byte == '>' || byte == '"' || byte == '{' || byte == '}' ||
         byte == '|' || byte == '\\' || byte == '^' || byte == '`' || byte == 0x7F;
}

// The IRI of a file on this machine: "file:///" and its absolute path, percent-encoded.
std::string file_iri(std::string_view path);

}  // namespace sinew::rdf
