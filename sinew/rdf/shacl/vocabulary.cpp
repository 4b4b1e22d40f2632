#include "sinew/rdf/shacl/vocabulary.h"

#include <string>

#include "sinew/graph/standard_iris.h"

namespace sinew::rdf::shacl {
namespace {

using graph::kRdf;
using graph::kXsd;
constexpr std::string_view kRdfs = "http://www.w3.org/2000/01/rdf-schema#";
constexpr std::string_view kOwl = "http://www.w3.org/2002/07/owl#";

struct Row {
  Id Vocabulary::*term;
  std::string_view name_space, name;
};

using V = Vocabulary;
constexpr Row kRows[] = {
    {&V::rdf_type, kRdf, "type"},
    {&V::rdf_first, kRdf, "first"},
    {&V::rdf_rest, kRdf, "rest"},
    {&V::rdf_nil, kRdf, "nil"},
    {&V::rdf_lang_string, kRdf, "langString"},
    {&V::rdfs_class, kRdfs, "Class"},
    {&V::rdfs_sub_class_of, kRdfs, "subClassOf"},
    {&V::owl_imports, kOwl, "imports"},
    {&V::xsd_string, kXsd, "string"},
    {&V::xsd_boolean, kXsd, "boolean"},
    {&V::xsd_integer, kXsd, "integer"},
    {&V::xsd_any_uri, kXsd, "anyURI"},
    {&V::node_shape, kSh, "NodeShape"},
    {&V::property_shape, kSh, "PropertyShape"},
    {&V::target_node, kSh, "targetNode"},
    {&V::target_class, kSh, "targetClass"},
    {&V::target_subjects_of, kSh, "targetSubjectsOf"},
    {&V::target_objects_of, kSh, "targetObjectsOf"},
    {&V::path, kSh, "path"},
    {&V::inverse_path, kSh, "inversePath"},
    {&V::alternative_path, kSh, "alternativePath"},
    {&V::zero_or_more_path, kSh, "zeroOrMorePath"},
    {&V::one_or_more_path, kSh, "oneOrMorePath"},
    {&V::zero_or_one_path, kSh, "zeroOrOnePath"},
    {&V::severity, kSh, "severity"},
    {&V::violation, kSh, "Violation"},
    {&V::warning, kSh, "Warning"},
    {&V::info, kSh, "Info"},
    {&V::message, kSh, "message"},
    {&V::deactivated, kSh, "deactivated"},
    {&V::flags, kSh, "flags"},
    {&V::ignored_properties, kSh, "ignoredProperties"},
    {&V::property, kSh, "property"},
    {&V::closed, kSh, "closed"},
    {&V::pattern, kSh, "pattern"},
    {&V::qualified_value_shape, kSh, "qualifiedValueShape"},
    {&V::qualified_min_count, kSh, "qualifiedMinCount"},
    {&V::qualified_max_count, kSh, "qualifiedMaxCount"},
    {&V::qualified_disjoint, kSh, "qualifiedValueShapesDisjoint"},
    {&V::sparql, kSh, "sparql"},
    {&V::select, kSh, "select"},
    {&V::ask, kSh, "ask"},
    {&V::prefixes, kSh, "prefixes"},
    {&V::declare, kSh, "declare"},
    {&V::prefix, kSh, "prefix"},
    {&V::name_space, kSh, "namespace"},
    {&V::constraint_component, kSh, "ConstraintComponent"},
    {&V::parameter, kSh, "parameter"},
    {&V::optional, kSh, "optional"},
    {&V::validator, kSh, "validator"},
    {&V::node_validator, kSh, "nodeValidator"},
    {&V::property_validator, kSh, "propertyValidator"},
    {&V::label_template, kSh, "labelTemplate"},
    {&V::validation_report, kSh, "ValidationReport"},
    {&V::validation_result, kSh, "ValidationResult"},
    {&V::conforms, kSh, "conforms"},
    {&V::result, kSh, "result"},
    {&V::detail, kSh, "detail"},
    {&V::focus_node, kSh, "focusNode"},
    {&V::result_path, kSh, "resultPath"},
    {&V::value, kSh, "value"},
    {&V::source_constraint, kSh, "sourceConstraint"},
    {&V::source_constraint_component, kSh, "sourceConstraintComponent"},
    {&V::source_shape, kSh, "sourceShape"},
    {&V::result_severity, kSh, "resultSeverity"},
    {&V::result_message, kSh, "resultMessage"},
};

}  // namespace

Vocabulary::Vocabulary(graph::Terms& terms) {
  for (const Row& row : kRows) {
    this->*row.term = terms.iri(std::string(row.name_space) + std::string(row.name));
  }
}

}  // namespace sinew::rdf::shacl
