#include "sinew/rdf/turtle/reader.h"

#include "sinew/rdf/turtle/grammars.h"

namespace sinew::rdf {

std::optional<Syntax> syntax_of_file(std::string_view name) {
  if (name.ends_with(".ttl")) return Syntax::kTurtle;
  if (name.ends_with(".trig")) return Syntax::kTriG;
  if (name.ends_with(".nt")) return Syntax::kNTriples;
  if (name.ends_with(".nq")) return Syntax::kNQuads;
  return std::nullopt;
}

Prefixes read_rdf(std::string_view text, Syntax syntax, const ReadOptions& options,
                  graph::Terms& terms, const QuadSink& sink) {
  const bool graphs = syntax == Syntax::kTriG || syntax == Syntax::kNQuads;
  if (syntax == Syntax::kTurtle || syntax == Syntax::kTriG) {
    return read_turtle(text, graphs, options, terms, sink);
  }
  read_lines(text, graphs, options, terms, sink);
  return {};
}

}  // namespace sinew::rdf
