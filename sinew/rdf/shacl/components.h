// The constraint components of SHACL as a table: their IRIs, their parameters, which shapes may
// have them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace sinew::rdf::shacl {

enum class Component : std::uint8_t {
  // Value type (section 4.1)
  kClass,
  kDatatype,
  kNodeKind,
  // Cardinality (4.2)
  kMinCount,
  kMaxCount,
  // Value range (4.3)
  kMinExclusive,
  kMinInclusive,
  kMaxExclusive,
  kMaxInclusive,
  // Strings (4.4)
  kMinLength,
  kMaxLength,
  kPattern,
  kLanguageIn,
  kUniqueLang,
  // Property pairs (4.5)
  kEquals,
  kDisjoint,
  kLessThan,
  kLessThanOrEquals,
  // Logic (4.6)
  kNot,
  kAnd,
  kOr,
  kXone,
  // Shapes (4.7)
  kNode,
  kProperty,
  kQualifiedMinCount,
  kQualifiedMaxCount,
  // Others (4.8)
  kClosed,
  kHasValue,
  kIn,
  // SHACL-SPARQL: sh:sparql (5.1), and components that a shapes graph defines (6)
  kSparql,
  kCustom,
};

// How the values of a component's first parameter read.
enum class ParameterForm : std::uint8_t {
  kEachIri,  // one constraint for each value
  kOneIri,
  kNodeKind,
  kCount,  // one non-negative integer
  kOneLiteral,
  kPattern,       // one string, with sh:flags
  kLanguageList,  // one list of strings
  kFlag,          // one boolean; false is no constraint
  kEachShape,
  kEachShapeList,
  kQualified,  // sh:qualifiedValueShape and its companions
  kClosed,     // one boolean, with sh:ignoredProperties
  kEachValue,
  kOneList,  // one list of anything
  kEachSparql,
};

struct ComponentRow {
  Component component;
  std::string_view parameter;  // its name behind sh:
  std::string_view name;       // the component's IRI behind sh:
  ParameterForm form;
  bool property_shapes_only = false;
};

// Every component but kCustom, in the order of the enumeration.
std::span<const ComponentRow> components();
std::string_view component_name(Component component);

}  // namespace sinew::rdf::shacl
