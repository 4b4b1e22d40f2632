// How the syntax tree is written in the graph: one row for each kind of node, one for each of its
// texts. Terms are those of https://w3id.org/sinew/data#, whose JSON-LD context is
// metamodels/sinew/data.json.
//
// Children that no row names lie in a list, data:entries, in their order. A prototype's fields are
// properties of the prototype itself; the normal form of the text has them in the order of this
// table.
#pragma once

#include <span>
#include <string_view>

namespace sinew::blocks {

inline constexpr std::string_view kDataNamespace = "https://w3id.org/sinew/data#";
inline constexpr std::string_view kDataContext = "https://w3id.org/sinew/data.json";

enum class TextStyle : unsigned char {
  kLiteral,    // xsd:string
  kList,       // several, in a list of xsd:string
  kReference,  // the IRI of an item; `refers_to` says of which kind
};

struct TextRow {
  std::string_view text;       // in the tree
  std::string_view predicate;  // in the graph, after the namespace
  TextStyle style = TextStyle::kLiteral;
  std::string_view refers_to = {};  // the kind of item
};

struct KindRow {
  std::string_view kind;
  std::string_view type;  // the rdf:type, after the namespace
  std::span<const TextRow> texts;
  bool named = false;  // an item whose name makes its IRI
};

std::span<const KindRow> kind_rows();
const KindRow* find_kind(std::string_view kind);
const KindRow* find_type(std::string_view type);

// The fields of a prototype, in their normal order.
struct FieldRow {
  std::string_view kind;
  std::string_view predicate;       // its value, or its list of entries
  std::string_view form_predicate;  // of a value that is written out as a form
  TextStyle style = TextStyle::kLiteral;
  std::string_view refers_to = {};
  std::string_view written_out = {};  // the kind of node that may stand in place of a reference
  std::string_view entry_kind = {};   // the field is a list of these
};
std::span<const FieldRow> field_rows();

}  // namespace sinew::blocks
