// Turtle and TriG from quads; behind write_rdf.
#pragma once

#include "sinew/rdf/turtle/writer.h"

namespace sinew::rdf {

std::string write_turtle(std::span<const graph::Quad> quads, bool graphs, const graph::Terms& terms,
                         const Prefixes& prefixes);

}  // namespace sinew::rdf
