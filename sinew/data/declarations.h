// What a description of data says, before it is checked: plain lists with a place for each entry.
// Front ends (the block language, the graph, C++ code) fill them; make_library checks them and
// makes a Library.
//
// Names are fully qualified ("module.name"); references to names that nobody declares are found
// there.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/data/algebraic.h"

namespace sinew::data {

// Domains: which annotations a prototype has to have, which meanings there are, and in which
// coordinates they can be expressed.
struct AnnotationDeclaration {
  std::string name;
  bool optional = false;
  std::vector<std::string> values;  // allowed; empty: any
  Place place;
};
struct CompositeDeclaration {
  std::string name;
  std::vector<std::string> members;
  Place place;
};
struct ParameterDeclaration {
  std::string name;
  std::string unit;  // an SI unit: its dimension is the parameter's
  std::optional<double>
      constant;  // always this number (the last row of a homogeneous transformation)
  Place place;
};
struct CoordinatesDeclaration {
  std::string name;
  std::vector<std::string> semantics;
  std::optional<Algebraic>
      shape;  // a Vector or Matrix by whose indices the parameters go, in their order
  std::vector<ParameterDeclaration> parameters;
  Place place;
};
// One side of a formula: coordinates, or the coordinates of each member of a composite.
struct FormulaSide {
  std::string coordinates;
  std::vector<std::pair<std::string, std::string>> members;  // member and its coordinates
};
struct FormulaDeclaration {
  FormulaSide from, to;
  std::string semantic;
  std::string loses;  // what the formula cannot carry over; empty: nothing
  std::string text;
  Place place, text_place;
};
struct ConventionDeclaration {
  std::string name;                    // reference_point
  std::vector<std::string> semantics;  // whose prototypes have to state it, or may where optional
  bool optional = false;
  Place place;
};
// A formula's text with its place.
struct FormulaText {
  std::string text;
  Place place;
};
// How relations between frames are put together, in one kind of coordinates.
struct RelationRuleDeclaration {
  std::string coordinates, semantic;
  FormulaText identity;  // of a frame with itself; no inputs
  FormulaText inverse;   // from the relation's own parameters
  FormulaText product;   // from `first`, of B in A, and `second`, of C in B: of C in A
  Place place;
};
// What a value becomes when one of its conventions changes.
struct ChangeInput {
  std::string name;    // of the relation in the formula
  std::string of, in;  // "old", "new", or a convention of the value
  Place place;
};
struct ChangeDeclaration {
  std::string convention, coordinates;
  std::vector<std::string> semantics;
  std::vector<ChangeInput> inputs;
  std::string needs;  // instead of a formula: what it would take
  FormulaText formula;
  Place place;
};
struct DomainDeclaration {
  std::string name;
  std::vector<std::string> older_names;
  std::vector<AnnotationDeclaration> annotations;
  std::vector<CompositeDeclaration> composites;
  std::vector<CoordinatesDeclaration> coordinates;
  std::vector<FormulaDeclaration> formulas;
  std::vector<ConventionDeclaration> conventions;
  std::vector<RelationRuleDeclaration> relation_rules;
  std::vector<ChangeDeclaration> changes;
  Place place;
};

struct AlgebraicDeclaration {
  std::string name;
  Algebraic algebraic;
  Place place;
};
struct RepresentationDeclaration {
  std::string name;
  std::string context, text;
  Place place;
};
struct UnitEntry {
  std::string unit;
  Accessor accessor;
  Place place;
};
struct UnitsDeclaration {
  std::string name;
  std::string ontology;
  std::string algebraic;
  std::vector<UnitEntry> entries;
  Place place;
};

// left = [-] right, or left = const number.
struct MapEntry {
  Accessor left;
  bool negative = false;
  std::optional<double> constant;
  Accessor right;
  Place place;
};
struct AliasDeclaration {
  std::string left, right;
  std::vector<MapEntry> entries;
  Place place;
};

struct Field {  // one "name = value" of a prototype, with its place
  std::string value;
  Place place;
  bool given() const { return !value.empty(); }
};
struct PrototypeDeclaration {
  std::string name;
  Field domain, semantic, coordinates, algebraic, representation, units;
  std::vector<MapEntry> map;  // dr: part of the representation = algebraic accessor, or = member
  bool has_map = false;
  std::vector<std::pair<std::string, Field>> members;     // composes: member and its prototype
  std::vector<std::pair<std::string, Field>> convention;  // what the domain asks to be stated
  Place place;
};
struct ViewDeclaration {
  std::string prototype, member, target;
  std::vector<MapEntry> entries;  // element of the prototype = element of the target
  std::string function;           // instead of entries
  Place place;
};

// The relation of one frame to another, as a prototype says it: a value that is given when a
// conversion runs, or, with entries (part of the representation = const number), one that never
// changes.
struct RelationDeclaration {
  std::string frame, reference, prototype;
  std::vector<MapEntry> entries;
  bool constant = false;
  Place place;
};

struct ArgumentDeclaration {
  std::size_t position = 0;            // 0 is the return value
  bool input = false, output = false;  // both: the function changes what is there
  std::string prototype;               // or, in the context "coordinates", DOMAIN.COORDINATES
  Place place;
};
struct FunctionDeclaration {
  std::string name;
  std::string context;  // c99, cpp, coordinates
  std::string library, symbol, header;
  std::vector<ArgumentDeclaration> arguments;
  Place place;
};
struct ConversionDeclaration {
  std::string from, to, function;
  std::optional<double> cost;  // in additions
  std::optional<double> worst_case_s;
  std::string loses;
  Place place;
};

struct Declarations {
  std::vector<DomainDeclaration> domains;
  std::vector<AlgebraicDeclaration> algebraics;
  std::vector<RepresentationDeclaration> representations;
  std::vector<UnitsDeclaration> units;
  std::vector<AliasDeclaration> aliases;
  std::vector<PrototypeDeclaration> prototypes;
  std::vector<ViewDeclaration> views;
  std::vector<FunctionDeclaration> functions;
  std::vector<ConversionDeclaration> conversions;
  std::vector<RelationDeclaration> relations;
};

}  // namespace sinew::data
