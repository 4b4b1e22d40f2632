// Result sets from TSV: variables with '?', terms in the syntax of Turtle without prefixes.
#include <fmt/format.h>

#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/results/codecs.h"
#include "sinew/rdf/turtle/blank_scope.h"
#include "sinew/rdf/turtle/scanner.h"

namespace sinew::rdf {
namespace {

using graph::Id;

class TsvReader {
 public:
  TsvReader(std::string_view text, std::string_view file, graph::Terms& terms)
      : scanner_(text, file), file_(file), terms_(terms), blanks_(terms) {}

  ResultSet read() {
    if (scanner_.at_end()) scanner_.fail("there are no results", "begin with a line of variables");
    if (!at_line_end()) {
      do variable();
      while (scanner_.accept('\t'));
    }
    end_line("the end of the variables");
    while (!scanner_.at_end()) row();
    return builder_.finish(place(), true);
  }

 private:
  void variable() {
    const Place start = place();
    if (!scanner_.accept('?') && !scanner_.accept('$')) {
      scanner_.fail(fmt::format("there is {} where a variable should be", scanner_.describe_next()),
                    "write it as ?name");
    }
    const std::size_t begin = scanner_.offset();
    while (!scanner_.at_end() && scanner_.peek() != '\t' && !at_line_end()) scanner_.advance();
    builder_.add_column(scanner_.text().substr(begin, scanner_.offset() - begin), start);
  }

  void row() {
    builder_.add_row(place());
    for (std::size_t i = 0; i < builder_.column_count(); ++i) {
      if (i > 0 && !scanner_.accept('\t')) {
        scanner_.fail(
            fmt::format("there is {} where a tab should be", scanner_.describe_next()),
            fmt::format("give each of the {} variables a value, an empty one where there is none",
                        builder_.column_count()));
      }
      const bool unbound = scanner_.at_end() || scanner_.peek() == '\t' || at_line_end();
      if (unbound) continue;
      const Place start = place();
      builder_.bind(i, term(), start);
    }
    end_line("the end of the row");
  }

  Id term() {
    const char next = scanner_.peek();
    if (next == '<') return iri();
    if (next == '"' || next == '\'') return literal();
    if (next == '_' && scanner_.peek(1) == ':') {
      scanner_.advance(2);
      return blanks_.node(scanner_.blank_label());
    }
    if ((next >= '0' && next <= '9') || next == '+' || next == '-' || next == '.') {
      const Scanner::Number number = scanner_.number();
      const char* type = number.kind == Scanner::NumberKind::kInteger   ? "integer"
                         : number.kind == Scanner::NumberKind::kDecimal ? "decimal"
                                                                        : "double";
      return terms_.literal(number.text, std::string(graph::kXsd) + type);
    }
    for (const bool value : {true, false}) {
      const std::string_view word = value ? "true" : "false";
      if (!scanner_.text().substr(scanner_.offset()).starts_with(word)) continue;
      scanner_.advance(word.size());
      return terms_.boolean(value);
    }
    scanner_.fail(fmt::format("there is {} where a term should be", scanner_.describe_next()),
                  "write <iri>, _:label, a \"literal\" or a number");
  }

  Id iri() {
    const Scanner::Position start = scanner_.position();
    const std::string_view text = scanner_.iri_reference();
    if (!is_absolute_iri(text)) {
      scanner_.fail(start, fmt::format("<{}> is not absolute", text), "write the IRI in full");
    }
    return terms_.iri(text);
  }

  Id literal() {
    const std::string value(scanner_.string_literal());
    if (scanner_.peek() == '@') return terms_.literal(value, {}, scanner_.language_tag());
    if (scanner_.peek() != '^') return terms_.literal(value);
    if (scanner_.peek(1) != '^' || scanner_.peek(2) != '<') {
      scanner_.fail("a literal's type is missing", "write it as ^^<iri>");
    }
    scanner_.advance(2);
    return terms_.literal(value, iri());
  }

  bool at_line_end() const { return scanner_.peek() == '\n' || scanner_.peek() == '\r'; }
  void end_line(const char* what) {
    if (scanner_.at_end() || scanner_.accept_line_end()) return;
    scanner_.fail(fmt::format("there is {} where {} should be", scanner_.describe_next(), what),
                  "separate by tabs and begin each row on its own line");
  }
  Place place() const { return {file_, scanner_.position().line, scanner_.position().column}; }

  Scanner scanner_;
  std::string file_;
  graph::Terms& terms_;
  BlankScope blanks_;
  ResultBuilder builder_;
};

}  // namespace

ResultSet read_tsv(std::string_view text, std::string_view file, graph::Terms& terms) {
  return TsvReader(text, file, terms).read();
}

}  // namespace sinew::rdf
