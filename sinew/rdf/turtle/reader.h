// Reading Turtle, TriG, N-Triples and N-Quads (RDF 1.1).
//
// Quads go to a sink as they are read, in the order of the text, with the place of the object
// (where a later stage will want to point when the value is wrong). Blank nodes belong to the
// document: "_:a" in one text is never the same node as "_:a" in another.
//
// The first fault ends the reading with an Error that has file, line, column and remedy; quads that
// came before it have gone to the sink already, so read into a Transaction that is dropped on
// Error.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "sinew/graph/store.h"
#include "sinew/rdf/iri/prefixes.h"
#include "sinew/rdf/turtle/limits.h"

namespace sinew::rdf {

enum class Syntax { kTurtle, kTriG, kNTriples, kNQuads };

// By the end of the name: .ttl .trig .nt .nq; nothing for any other.
std::optional<Syntax> syntax_of_file(std::string_view name);

struct ReadOptions {
  std::string file;      // for messages; may be empty
  std::string base;      // absolute IRI against which relative ones resolve; empty: there is none
  graph::Id graph = {};  // what the text leaves in the unnamed graph goes here
};

// Lines and columns count from 1; columns count characters.
using QuadSink = std::function<void(const graph::Quad& quad, std::size_t line, std::size_t column)>;

// Returns the prefixes that the document declares (none for N-Triples and N-Quads).
Prefixes read_rdf(std::string_view text, Syntax syntax, const ReadOptions& options,
                  graph::Terms& terms, const QuadSink& sink);

}  // namespace sinew::rdf
