#include "sinew/rdf/shacl/validator.h"
namespace sinew::rdf::shacl {
void check_sparql(Check&) {}
}  // namespace sinew::rdf::shacl
