// N-Triples and N-Quads: one statement a line, every term written in full.
#include <fmt/format.h>

#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/turtle/blank_scope.h"
#include "sinew/rdf/turtle/grammars.h"
#include "sinew/rdf/turtle/scanner.h"

namespace sinew::rdf {
namespace {

using graph::Id;

class LineReader {
 public:
  LineReader(std::string_view text, const ReadOptions& options, graph::Terms& terms)
      : scanner_(text, options.file), terms_(terms), blanks_(terms) {}

  void read(bool graphs, Id unnamed_graph, const QuadSink& sink) {
    while (true) {
      do scanner_.skip_blanks();
      while (scanner_.accept_line_end());
      if (scanner_.peek() != '#') {
        if (scanner_.at_end()) return;
        statement(graphs, unnamed_graph, sink);
        scanner_.skip_blanks();
      }
      scanner_.skip_comment();
      if (!scanner_.at_end() && !scanner_.accept_line_end()) {
        scanner_.fail(fmt::format("there is {} behind a statement", scanner_.describe_next()),
                      "begin the next statement on a line of its own");
      }
    }
  }

 private:
  void statement(bool graphs, Id unnamed_graph, const QuadSink& sink) {
    graph::Quad quad;
    quad.subject = node("a subject");
    scanner_.skip_blanks();
    quad.predicate = scanner_.peek() == '<' ? iri() : expected("a predicate", "write it as <iri>");
    scanner_.skip_blanks();
    const Scanner::Position place = scanner_.position();
    quad.object = scanner_.peek() == '"' ? literal() : node("an object");
    scanner_.skip_blanks();
    quad.graph = unnamed_graph;
    if (graphs && (scanner_.peek() == '<' || scanner_.peek() == '_')) {
      quad.graph = node("a graph");
      scanner_.skip_blanks();
    }
    if (!scanner_.accept('.')) expected("the end of the statement", "close it with a .");
    sink(quad, place.line, place.column);
  }

  Id expected(const char* what, const char* remedy) {
    scanner_.fail(fmt::format("there is {} where {} should be", scanner_.describe_next(), what),
                  remedy);
  }

  Id node(const char* role) {
    if (scanner_.peek() == '<') return iri();
    if (scanner_.peek() == '_' && scanner_.peek(1) == ':') {
      scanner_.advance(2);
      return blanks_.node(scanner_.blank_label());
    }
    return expected(role, "write it as <iri> or _:label");
  }

  Id iri() {
    const Scanner::Position start = scanner_.position();
    const std::string_view text = scanner_.iri_reference();
    if (!is_absolute_iri(text)) {
      scanner_.fail(start, fmt::format("<{}> is not absolute", text),
                    "N-Triples and N-Quads have no base: write the IRI in full");
    }
    return terms_.iri(text);
  }

  Id literal() {
    const std::string_view value = scanner_.short_string();
    if (scanner_.peek() == '@') {
      // The tag points into the text, so the value is still there.
      const std::string_view tag = scanner_.language_tag();
      return terms_.literal(value, {}, tag);
    }
    if (scanner_.peek() != '^') return terms_.literal(value);
    value_.assign(value);
    if (scanner_.peek(1) != '^' || scanner_.peek(2) != '<') {
      expected("a literal's type", "write it as ^^<iri>");
    }
    scanner_.advance(2);
    return terms_.literal(value_, iri());
  }

  Scanner scanner_;
  graph::Terms& terms_;
  BlankScope blanks_;
  std::string value_;
};

}  // namespace

void read_lines(std::string_view text, bool graphs, const ReadOptions& options, graph::Terms& terms,
                const QuadSink& sink) {
  LineReader(text, options, terms).read(graphs, options.graph, sink);
}

}  // namespace sinew::rdf
