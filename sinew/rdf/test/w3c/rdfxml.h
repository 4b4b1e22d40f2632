// As much of RDF/XML as the data of the SPARQL suite need: node elements with rdf:about or
// rdf:nodeID, property elements with text, rdf:datatype, xml:lang, rdf:resource, rdf:nodeID or one
// node within. For tests only: Sinew itself does not read RDF/XML. Whatever else occurs is an
// Error, so that no test can pass because something was overlooked.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/store.h"

namespace sinew::rdf::w3c {

std::vector<graph::Quad> read_rdf_xml(std::string_view text, const std::string& base,
                                      graph::Terms& terms);

}  // namespace sinew::rdf::w3c
