// RDF terms as 32-bit ids. A term is interned once; equal terms have equal ids, so that the store
// and the query engine compare integers only.
//
// Four kinds of terms: IRIs, blank nodes, literals, and *derived* nodes. A derived node is an IRI
// that is known by what it is made of (a role and the nodes it stands for) instead of by its text;
// making one costs a hash of integers. Its text, a name-based UUID (RFC 4122, version 5) of the
// same facts, is made only when somebody asks for it, so the same model and query always give the
// same IRIs. Should that very IRI also arrive as text (a model that was written out and is read
// back), it is the same term.
//
// Thread safety: one thread may add terms while others look up and read terms that already exist.
// Nothing ever moves, so reading takes no lock; only making a text that is made on demand does.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sinew::graph {

// 0 is no term: a wildcard in patterns, "unbound" in solutions, the default graph in quads.
struct Id {
  std::uint32_t value = 0;
  constexpr explicit operator bool() const { return value != 0; }
  friend constexpr auto operator<=>(Id, Id) = default;
};

enum class TermKind : std::uint8_t { kNone, kIri, kBlank, kLiteral, kDerived };

// Ids are 1 .. kMaxTerms.
inline constexpr std::uint32_t kMaxTerms = UINT32_MAX - 1;
// Bytes of one text, and of a language tag.
inline constexpr std::size_t kMaxTextSize = UINT32_MAX;
inline constexpr std::size_t kMaxLanguageSize = UINT16_MAX;
// What the IRI of a derived node starts with; the UUID follows.
inline constexpr std::string_view kDerivedPrefix = "https://w3id.org/sinew/id/";

class Terms {
 public:
  // The datatypes of XML Schema that have numeric values, and a few more, are terms from the start.
  explicit Terms(std::uint32_t limit = kMaxTerms);
  ~Terms();
  Terms(const Terms&) = delete;
  Terms& operator=(const Terms&) = delete;
  // A copy with the same ids and a life of its own; the texts are shared, not copied.
  std::unique_ptr<Terms> clone() const;

  // Interning. Strings are copied. Throws Error when `limit` terms exist, or when a text is too
  // long.
  Id iri(std::string_view text);
  // The label is local to this dictionary. A label of the form that fresh nodes get on output
  // ("fresh" and digits) is kept apart from theirs by one more underscore at its end.
  Id blank(std::string_view label);
  Id fresh_blank();  // a blank node that nothing else names; label made on output
  // An empty datatype means xsd:string; a language makes it rdf:langString.
  Id literal(std::string_view lexical, std::string_view datatype = {},
             std::string_view language = {});
  Id literal(std::string_view lexical, Id datatype);
  Id integer(std::int64_t value);
  Id real(double value);  // xsd:double, shortest text that reads back to the same value
  Id boolean(bool value);
  // A node made of `role` (an IRI) and the nodes it stands for, in this order. Its IRI depends on
  // their texts only: it is reproducible unless a part is a blank node whose label is not.
  Id derived(Id role, std::span<const Id> parts);
  Id derived(Id role, std::initializer_list<Id> parts);

  // Looking up without adding; the null Id when there is no such term.
  Id find_iri(std::string_view text) const;
  Id find_blank(std::string_view label) const;
  Id find_literal(std::string_view lexical, std::string_view datatype = {},
                  std::string_view language = {}) const;

  // Reading. All views stay valid as long as the dictionary does.
  TermKind kind(Id id) const;
  bool is_iri(Id id) const { return kind(id) == TermKind::kIri || kind(id) == TermKind::kDerived; }
  bool is_blank(Id id) const { return kind(id) == TermKind::kBlank; }
  bool is_literal(Id id) const { return kind(id) == TermKind::kLiteral; }
  // The IRI, the blank node's label or the literal's lexical form. Makes a derived node's IRI.
  std::string_view text(Id id) const;
  Id datatype(Id literal) const;                   // an IRI's id
  std::string_view language(Id literal) const;     // as written; empty unless rdf:langString
  std::optional<double> number(Id literal) const;  // any valid xsd numeric literal's value
  std::optional<std::int64_t> integer_value(Id literal) const;  // of xsd:integer and its subtypes
  std::size_t size() const;

  // N-Triples form: <iri>, _:label, "lexical"^^<datatype>, "lexical"@language.
  std::string to_string(Id id) const;

 private:
  struct Data;
  explicit Terms(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

}  // namespace sinew::graph

template <>
struct std::hash<sinew::graph::Id> {
  std::size_t operator()(sinew::graph::Id id) const noexcept {
    return std::size_t{id.value} * 0x9E3779B97F4A7C15ull >> 16;
  }
};
