#include "sinew/rdf/shacl/shape_parser.h"
namespace sinew::rdf::shacl {
struct ShapeParser::CustomComponent {};
void ShapeParser::find_custom_components() {}
void ShapeParser::sparql_constraint(Id, Shape&, Id) {}
void ShapeParser::custom_constraints(Id, Shape&) {}
}  // namespace sinew::rdf::shacl
