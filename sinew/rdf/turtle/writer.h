// Writing Turtle, TriG, N-Triples and N-Quads.
//
// Turtle and TriG are for people: prefixes, blank nodes where they are used, lists, everything
// sorted. The same quads give the same text, whatever the order in which they come and whatever the
// ids. N-Triples and N-Quads are for machines and for comparing: the canonical form of each term.
//
// Nothing is dropped or bent: an IRI that cannot be written is an Error, and so are named graphs in
// a syntax that has none.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/iri/prefixes.h"
#include "sinew/rdf/turtle/reader.h"

namespace sinew::rdf {

struct WriteOptions {
  Prefixes prefixes;   // for Turtle and TriG; those that are not used are not written
  bool sorted = true;  // N-Triples and N-Quads: lines in the order of their text, else as given
};

std::string write_rdf(std::span<const graph::Quad> quads, Syntax syntax, const graph::Terms& terms,
                      const WriteOptions& options = {});

// Every quad that a view sees, graph by graph; for writing a whole store.
std::vector<graph::Quad> quads_of(const graph::View& view);

// Blank nodes are written one in the other up to this depth; deeper ones get a label, so that
// readers with a limit (see limits.h) can read what was written.
inline constexpr std::size_t kMaxWrittenNesting = 64;

}  // namespace sinew::rdf
