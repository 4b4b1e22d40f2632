// A validation report for machines and for people: as a graph (SHACL, section 3.6), as problems
// with file and line of the focus node, as text, and as JSON.
#pragma once

#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/rdf/shacl/validation.h"

namespace sinew::rdf::shacl {

// Every quad of the report, in the graph given. The first one's subject is the sh:ValidationReport.
// Messages are those of the shapes; where there is none, our own, in English.
std::vector<graph::Quad> to_graph(const ValidationReport& report, graph::Store& store,
                                  Id graph = {});

// One problem a result, at the place of the property of the focus node, or of the focus node. Of
// severity kError for sh:Violation and severities that SHACL does not know, kWarning for sh:Warning
// and sh:Info.
std::vector<Problem> to_problems(const ValidationReport& report, const graph::Terms& terms,
                                 const graph::Places* places = nullptr);

// Lines "file:line: IRI: what is wrong; what would be right", the reasons of sh:node indented
// below. "conforms" where nothing is wrong.
std::string to_text(const ValidationReport& report, const graph::Terms& terms,
                    const graph::Places* places = nullptr);

// {"conforms": false, "results": [{"focusNode": {"type": "uri", "value": "…"}, "path": "…",
// "value": {…},
//   "severity": "…", "component": "…", "shape": {…}, "messages": […], "problem": "…", "remedy":
//   "…", "file": "…", "line": 3, "details": […]}]}; members without a value are left out. Terms are
//   as in
// SPARQL's JSON results: type uri, bnode or literal, with datatype or xml:lang.
std::string to_json(const ValidationReport& report, const graph::Terms& terms,
                    const graph::Places* places = nullptr);

}  // namespace sinew::rdf::shacl
