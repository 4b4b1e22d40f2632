// What the fuzz targets of this folder check: a text is either refused with an Error that has a
// place and a remedy, or it means the same after it has been written and read again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/rdf/isomorphism/isomorphism.h"
#include "sinew/rdf/turtle/reader.h"
#include "sinew/rdf/turtle/writer.h"

namespace sinew::rdf::fuzz {

inline void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

inline std::vector<graph::Quad> read(std::string_view text, Syntax syntax, graph::Terms& terms) {
  std::vector<graph::Quad> quads;
  read_rdf(text, syntax, {"fuzz", "http://base/", {}}, terms,
           [&](const graph::Quad& quad, std::size_t line, std::size_t column) {
             require(line > 0 && column > 0, "a quad without a place");
             quads.push_back(quad);
           });
  return quads;
}

inline void round_trip(std::string_view text, Syntax syntax) {
  graph::Terms terms;
  std::vector<graph::Quad> quads;
  try {
    quads = read(text, syntax, terms);
  } catch (const Error& error) {
    const Problem& problem = error.problems().front();
    require(problem.place.line > 0 && problem.place.column > 0, "an error without a place");
    require(!problem.remedy.empty(), "an error without a remedy");
    return;
  }
  const Prefixes prefixes{{"", "http://base/"}, {"a", "x:"}};
  for (const Syntax other : {Syntax::kTriG, Syntax::kNQuads}) {
    const std::string written = write_rdf(quads, other, terms, {prefixes, true});
    const std::vector<graph::Quad> again = read(written, other, terms);
    const Comparison same = compare_quads(quads, again, terms, 100'000);
    require(same.likeness != Likeness::kDifferent, "changed by writing");
  }
}

}  // namespace sinew::rdf::fuzz
