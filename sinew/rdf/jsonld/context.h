// Contexts as they are used: what each term means at some point of a document ("active context" in
// the standard). A Context never changes once it has been made, so that many nodes share it.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "sinew/rdf/json/value.h"
#include "sinew/rdf/jsonld/errors.h"

namespace sinew::jsonld {

// A setting that may be absent, explicitly null, or a text.
struct Setting {
  enum class State : std::uint8_t { kAbsent, kNull, kText };
  State state = State::kAbsent;
  std::string_view text;

  static Setting null() { return {State::kNull, {}}; }
  static Setting of(std::string_view text) { return {State::kText, text}; }
  bool is_absent() const { return state == State::kAbsent; }
  bool has_text() const { return state == State::kText; }
  friend bool operator==(const Setting&, const Setting&) = default;
};

// The keywords of @container, as a set.
struct Containers {
  enum : std::uint8_t {
    kGraph = 1,
    kId = 2,
    kIndex = 4,
    kLanguage = 8,
    kList = 16,
    kSet = 32,
    kType = 64,
  };
  std::uint8_t bits = 0;

  bool has(std::uint8_t any_of) const { return (bits & any_of) != 0; }
  friend bool operator==(Containers, Containers) = default;
};

struct TermDefinition {
  std::string_view iri;   // an IRI, a blank node or a keyword; empty: mapped to null
  std::string_view type;  // of the values: an IRI, @id, @vocab, @json, @none; empty: none
  Setting language;
  Setting direction;
  std::string_view index;  // the property that holds the keys of an @index map; empty: none
  std::string_view nest;   // empty: none
  Containers containers;
  bool prefix = false;
  bool reverse = false;
  bool is_protected = false;
  bool has_context = false;
  json::Value context;  // scoped to this term
  Source source;        // of the document that defines it
  json::Position position;
};

// True when both mean the same, whatever their protection and the place where they stand.
bool same_definition(const TermDefinition& a, const TermDefinition& b);

// Terms and their definitions; keeps the order in which terms were first set.
class TermTable {
 public:
  struct Entry {
    std::string_view term;
    const TermDefinition* definition;  // nullptr: removed
  };

  const TermDefinition* find(std::string_view term) const;
  void set(json::Arena& arena, std::string_view term, const TermDefinition* definition);
  std::span<const Entry> entries() const { return {entries_, size_}; }
  TermTable clone(json::Arena& arena) const;

 private:
  std::uint32_t* slot(std::string_view term) const;
  void grow(json::Arena& arena);

  Entry* entries_ = nullptr;
  std::uint32_t* slots_ = nullptr;  // open addressing, entry + 1
  std::uint32_t size_ = 0;
  std::uint32_t capacity_ = 0;  // of the entries; the table has four times as many slots
};

struct Context {
  TermTable terms;
  Setting base;
  std::string_view original_base;  // what @base goes back to; empty: none
  Setting vocab;
  Setting language;
  Setting direction;
  const Context* previous = nullptr;  // what holds again inside a nested node; nullptr: this one
  bool has_protected_terms = false;
};

}  // namespace sinew::jsonld
