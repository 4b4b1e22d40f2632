#include "sinew/rdf/turtle/writer.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/error.h"
#include "sinew/rdf/isomorphism/refinement.h"
#include "sinew/rdf/turtle/term_text.h"
#include "sinew/rdf/turtle/turtle_writer.h"

namespace sinew::rdf {
namespace {

using graph::Id;
using graph::Quad;

void refuse_graphs(std::span<const Quad> quads, const char* name, const char* other,
                   const graph::Terms& terms) {
  const auto named = std::ranges::find_if(quads, [](const Quad& quad) { return bool(quad.graph); });
  if (named == quads.end()) return;
  Problem problem;
  problem.iri = terms.text(named->graph);
  problem.what = fmt::format("{} has no named graphs, and this is one", name);
  problem.remedy = fmt::format("write {}, or choose one graph", other);
  throw Error(std::move(problem));
}

// One statement a line. Blank nodes are numbered in the order in which they appear, or, where the
// lines are to be sorted, by what they are, so that the lines do not depend on the ids.
std::string write_lines(std::span<const Quad> quads, const graph::Terms& terms, bool sorted) {
  BlankLabels labels;
  std::string text;
  if (sorted) {
    for (const Id node : ordered_blanks(quads, terms)) labels.append(text, node);
    text.clear();
  }
  const auto append = [&](Id id) {
    if (terms.is_blank(id)) {
      labels.append(text, id);
    } else {
      append_term(text, id, terms);
    }
    text += ' ';
  };
  std::vector<std::size_t> starts;
  for (const Quad& quad : quads) {
    if (sorted) starts.push_back(text.size());
    append(quad.subject);
    append(quad.predicate);
    append(quad.object);
    if (quad.graph) append(quad.graph);
    text += ".\n";
  }
  if (!sorted) return text;

  std::vector<std::string_view> lines;
  lines.reserve(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::size_t end = i + 1 < starts.size() ? starts[i + 1] : text.size();
    lines.push_back(std::string_view(text).substr(starts[i], end - starts[i]));
  }
  std::ranges::sort(lines);
  lines.erase(std::ranges::unique(lines).begin(), lines.end());
  std::string ordered;
  ordered.reserve(text.size());
  for (const std::string_view line : lines) ordered += line;
  return ordered;
}

}  // namespace

std::string write_rdf(std::span<const Quad> quads, Syntax syntax, const graph::Terms& terms,
                      const WriteOptions& options) {
  switch (syntax) {
    case Syntax::kTurtle:
      refuse_graphs(quads, "Turtle", "TriG", terms);
      return write_turtle(quads, false, terms, options.prefixes);
    case Syntax::kTriG:
      return write_turtle(quads, true, terms, options.prefixes);
    case Syntax::kNTriples:
      refuse_graphs(quads, "N-Triples", "N-Quads", terms);
      break;
    case Syntax::kNQuads:
      break;
  }
  return write_lines(quads, terms, options.sorted);
}

std::vector<Quad> quads_of(const graph::View& view) {
  std::vector<Quad> quads;
  const auto add = [&](const Quad& quad) {
    quads.push_back(quad);
    return true;
  };
  view.match_in({}, {}, {}, {}, add);
  view.match_named({}, {}, {}, add);
  return quads;
}

}  // namespace sinew::rdf
