// Short names for IRIs: prefix and namespace pairs, as Turtle, SPARQL and tables for people use
// them.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::rdf {

struct Prefix {
  std::string name;  // without the ':'; may be empty
  std::string iri;   // the namespace
  friend bool operator==(const Prefix&, const Prefix&) = default;
};

class Prefixes {
 public:
  Prefixes() = default;
  Prefixes(std::initializer_list<Prefix> list);

  // A name that is known already gets the new namespace.
  void set(std::string_view name, std::string_view iri);
  // Takes over the names of `others` that are not known here; the ones that are stay as they are.
  void add_missing(const Prefixes& others);

  // The namespace of a name, or nothing. The view is valid until the next set.
  std::optional<std::string_view> find(std::string_view name) const;
  // "name:rest" for the longest namespace that leaves a rest which needs no escapes in Turtle.
  std::optional<std::string> shorten(std::string_view iri) const;
  // The IRI meant by "name:rest", or nothing when the name is unknown or there is no ':'.
  std::optional<std::string> expand(std::string_view short_name) const;

  // In the order in which the names were first set.
  const std::vector<Prefix>& list() const { return list_; }
  bool empty() const { return list_.empty(); }

 private:
  std::vector<Prefix> list_;
};

}  // namespace sinew::rdf
