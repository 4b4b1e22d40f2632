// The terms of RDF, RDF Schema, OWL and SHACL that parsing and validation use, as ids of one
// dictionary.
#pragma once

#include <string_view>

#include "sinew/graph/standard_iris.h"
#include "sinew/graph/terms.h"

namespace sinew::rdf::shacl {

using graph::Id;

inline constexpr std::string_view kSh = "http://www.w3.org/ns/shacl#";

struct Vocabulary {
  explicit Vocabulary(graph::Terms& terms);

  Id rdf_type, rdf_first, rdf_rest, rdf_nil, rdf_lang_string;
  Id rdfs_class, rdfs_sub_class_of;
  Id owl_imports;
  Id xsd_string, xsd_boolean, xsd_integer, xsd_any_uri;

  Id node_shape, property_shape;
  Id target_node, target_class, target_subjects_of, target_objects_of;
  Id path, inverse_path, alternative_path, zero_or_more_path, one_or_more_path, zero_or_one_path;
  Id severity, violation, warning, info, message, deactivated;
  Id flags, ignored_properties, property, closed, pattern;
  Id qualified_value_shape, qualified_min_count, qualified_max_count, qualified_disjoint;
  Id sparql, select, ask, prefixes, declare, prefix, name_space;
  Id constraint_component, parameter, optional, validator, node_validator, property_validator;
  Id label_template;

  Id validation_report, validation_result, conforms, result, detail, focus_node, result_path, value;
  Id source_constraint, source_constraint_component, source_shape, result_severity, result_message;
};

}  // namespace sinew::rdf::shacl
