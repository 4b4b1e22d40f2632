#include "sinew/rdf/shacl/components.h"

namespace sinew::rdf::shacl {
namespace {

using C = Component;
using F = ParameterForm;
constexpr ComponentRow kRows[] = {
    {C::kClass, "class", "ClassConstraintComponent", F::kEachIri},
    {C::kDatatype, "datatype", "DatatypeConstraintComponent", F::kOneIri},
    {C::kNodeKind, "nodeKind", "NodeKindConstraintComponent", F::kNodeKind},
    {C::kMinCount, "minCount", "MinCountConstraintComponent", F::kCount, true},
    {C::kMaxCount, "maxCount", "MaxCountConstraintComponent", F::kCount, true},
    {C::kMinExclusive, "minExclusive", "MinExclusiveConstraintComponent", F::kOneLiteral},
    {C::kMinInclusive, "minInclusive", "MinInclusiveConstraintComponent", F::kOneLiteral},
    {C::kMaxExclusive, "maxExclusive", "MaxExclusiveConstraintComponent", F::kOneLiteral},
    {C::kMaxInclusive, "maxInclusive", "MaxInclusiveConstraintComponent", F::kOneLiteral},
    {C::kMinLength, "minLength", "MinLengthConstraintComponent", F::kCount},
    {C::kMaxLength, "maxLength", "MaxLengthConstraintComponent", F::kCount},
    {C::kPattern, "pattern", "PatternConstraintComponent", F::kPattern},
    {C::kLanguageIn, "languageIn", "LanguageInConstraintComponent", F::kLanguageList},
    {C::kUniqueLang, "uniqueLang", "UniqueLangConstraintComponent", F::kFlag, true},
    {C::kEquals, "equals", "EqualsConstraintComponent", F::kEachIri},
    {C::kDisjoint, "disjoint", "DisjointConstraintComponent", F::kEachIri},
    {C::kLessThan, "lessThan", "LessThanConstraintComponent", F::kEachIri, true},
    {C::kLessThanOrEquals, "lessThanOrEquals", "LessThanOrEqualsConstraintComponent", F::kEachIri,
     true},
    {C::kNot, "not", "NotConstraintComponent", F::kEachShape},
    {C::kAnd, "and", "AndConstraintComponent", F::kEachShapeList},
    {C::kOr, "or", "OrConstraintComponent", F::kEachShapeList},
    {C::kXone, "xone", "XoneConstraintComponent", F::kEachShapeList},
    {C::kNode, "node", "NodeConstraintComponent", F::kEachShape},
    {C::kProperty, "property", "PropertyShapeComponent", F::kEachShape},
    {C::kQualifiedMinCount, "qualifiedMinCount", "QualifiedMinCountConstraintComponent",
     F::kQualified},
    {C::kQualifiedMaxCount, "qualifiedMaxCount", "QualifiedMaxCountConstraintComponent",
     F::kQualified},
    {C::kClosed, "closed", "ClosedConstraintComponent", F::kClosed},
    {C::kHasValue, "hasValue", "HasValueConstraintComponent", F::kEachValue},
    {C::kIn, "in", "InConstraintComponent", F::kOneList},
    {C::kSparql, "sparql", "SPARQLConstraintComponent", F::kEachSparql},
};

}  // namespace

std::span<const ComponentRow> components() { return kRows; }

std::string_view component_name(Component component) {
  return component == Component::kCustom ? "" : kRows[static_cast<std::size_t>(component)].name;
}

}  // namespace sinew::rdf::shacl
