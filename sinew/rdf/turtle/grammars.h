// The two grammars behind read_rdf: one file each. Not for use outside this folder.
#pragma once

#include "sinew/rdf/turtle/reader.h"

namespace sinew::rdf {

// Turtle, and TriG where `graphs` says so.
Prefixes read_turtle(std::string_view text, bool graphs, const ReadOptions& options,
                     graph::Terms& terms, const QuadSink& sink);
// N-Triples, and N-Quads where `graphs` says so.
void read_lines(std::string_view text, bool graphs, const ReadOptions& options, graph::Terms& terms,
                const QuadSink& sink);

}  // namespace sinew::rdf
