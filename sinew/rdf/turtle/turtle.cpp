// Turtle and TriG: a function for each production of the grammar that needs one (Turtle,
// section 6.5; TriG, section 3.5). One byte of look-ahead is enough to choose.
#include <fmt/format.h>

#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/turtle/blank_scope.h"
#include "sinew/rdf/turtle/grammars.h"
#include "sinew/rdf/turtle/scanner.h"

namespace sinew::rdf {
namespace {

using graph::Id;
using Position = Scanner::Position;

bool equals_ignoring_case(std::string_view word, std::string_view upper) {
  if (word.size() != upper.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i] >= 'a' && word[i] <= 'z' ? static_cast<char>(word[i] - 32) : word[i];
    if (c != upper[i]) return false;
  }
  return true;
}

bool is_quote(char c) { return c == '"' || c == '\''; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c);
}

class TurtleReader {
 public:
  TurtleReader(std::string_view text, bool graphs, const ReadOptions& options, graph::Terms& terms,
               const QuadSink& sink)
      : scanner_(text, options.file),
        graphs_(graphs),
        base_(options.base),
        unnamed_graph_(options.graph),
        graph_(options.graph),
        terms_(terms),
        sink_(sink),
        blanks_(terms),
        type_(terms_.iri(graph::kRdfType)),
        first_(terms_.iri(graph::kRdfFirst)),
        rest_(terms_.iri(graph::kRdfRest)),
        nil_(terms_.iri(graph::kRdfNil)),
        integer_(terms_.iri(graph::kXsdInteger)),
        decimal_(terms_.iri(graph::kXsdDecimal)),
        double_(terms_.iri(graph::kXsdDouble)) {}

  Prefixes read() {
    for (scanner_.skip_space(); !scanner_.at_end(); scanner_.skip_space()) statement();
    return std::move(prefixes_);
  }

 private:
  // A node at the beginning of a statement, and what it may be.
  struct Subject {
    Id id;
    bool may_stand_alone = false;  // [ ... ] with properties
    bool may_name_graph = false;   // an IRI, a label or []
  };

  void statement() {
    if (scanner_.peek() == '@') return at_directive();
    if (graphs_ && scanner_.peek() == '{') return graph_block(unnamed_graph_);
    if (at_name()) {
      const Position start = scanner_.position();
      const Scanner::Name name = scanner_.name();
      if (name.has_colon) return statement_of({expand(name, start), false, true});
      return keyword_statement(name.prefix, start);
    }
    statement_of(subject());
  }

  // "@prefix ..." and "@base ...", which end with a '.' and are in lower case.
  void at_directive() {
    const Position start = scanner_.position();
    scanner_.advance();
    // Not a name: in "@prefix:" the colon is the prefix that is declared.
    const std::size_t begin = scanner_.offset();
    while (is_letter_or_digit(scanner_.peek())) scanner_.advance();
    const std::string_view word = scanner_.text().substr(begin, scanner_.offset() - begin);
    if (word == "prefix") {
      prefix_declaration();
    } else if (word == "base") {
      base_declaration();
    } else {
      scanner_.fail(start, "a directive is neither @prefix nor @base",
                    "write @prefix name: <iri> . or @base <iri> .");
    }
    expect_end("the directive");
  }

  void keyword_statement(std::string_view word, Position start) {
    if (equals_ignoring_case(word, "PREFIX")) return prefix_declaration();
    if (equals_ignoring_case(word, "BASE")) return base_declaration();
    if (graphs_ && equals_ignoring_case(word, "GRAPH")) {
      scanner_.skip_space();
      const Position label = scanner_.position();
      const Subject name = subject();
      if (!name.may_name_graph) {
        scanner_.fail(label, "a graph is named by a list or by a blank node with properties",
                      "name it by an IRI, a _:label or []");
      }
      scanner_.skip_space();
      if (scanner_.peek() != '{') expected("the triples of the graph", "open them with {");
      return graph_block(name.id);
    }
    unknown_word(word, start);
  }

  void prefix_declaration() {
    scanner_.skip_space();
    const Position start = scanner_.position();
    if (!at_name()) expected("a prefix", "write it as name: <iri>");
    const Scanner::Name name = scanner_.name();
    if (!name.has_colon || !name.local.empty()) {
      scanner_.fail(start, "a prefix does not end with a ':'", "write it as name: <iri>");
    }
    scanner_.skip_space();
    if (scanner_.peek() != '<') expected("the prefix's IRI", "write it as name: <iri>");
    const std::string_view iri = iri_text();
    prefixes_.set(name.prefix, iri);
  }

  void base_declaration() {
    scanner_.skip_space();
    if (scanner_.peek() != '<') expected("the base IRI", "write it as <iri>");
    const std::string iri(iri_text());
    base_ = iri;
  }

  void graph_block(Id name) {
    scanner_.advance();
    graph_ = name;
    for (scanner_.skip_space(); !scanner_.accept('}'); scanner_.skip_space()) {
      if (scanner_.at_end()) expected("the end of a graph", "close it with }");
      triples(subject());
      scanner_.skip_space();
      if (!scanner_.accept('.') && scanner_.peek() != '}') {
        expected("the end of the statement", "close it with a .");
      }
    }
    graph_ = unnamed_graph_;
  }

  // What begins with a subject: triples, or in TriG a graph of that name.
  void statement_of(Subject subject) {
    scanner_.skip_space();
    if (graphs_ && scanner_.peek() == '{' && subject.may_name_graph) {
      return graph_block(subject.id);
    }
    triples(subject);
    expect_end("the statement");
  }

  void triples(Subject subject) {
    scanner_.skip_space();
    const char next = scanner_.peek();
    if (subject.may_stand_alone && (next == '.' || next == '}')) return;
    predicates_and_objects(subject.id);
  }

  void predicates_and_objects(Id subject) {
    while (true) {
      scanner_.skip_space();
      const Id predicate = verb();
      do {
        scanner_.skip_space();
        const Position place = scanner_.position();
        emit(subject, predicate, object(), place);
        scanner_.skip_space();
      } while (scanner_.accept(','));
      if (scanner_.peek() != ';') return;
      while (scanner_.accept(';')) scanner_.skip_space();
      const char next = scanner_.peek();
      if (next == '.' || next == ']' || next == '}' || scanner_.at_end()) return;
    }
  }

  Subject subject() {
    switch (scanner_.peek()) {
      case '<':
        return {iri(), false, true};
      case '_':
        return {labelled_blank(), false, true};
      case '(':
        return {collection(), false, false};
      case '[': {
        bool empty = false;
        const Id node = blank_with_properties(empty);
        return {node, !empty, empty};
      }
      default:
        break;
    }
    if (!at_name()) expected("a subject", "begin it with <, [, (, _: or a prefix");
    return {prefixed_name(), false, true};
  }

  Id verb() {
    if (scanner_.peek() == '<') return iri();
    if (!at_name()) expected("a predicate", "write it as <iri>, prefix:name or a");
    const Position start = scanner_.position();
    const Scanner::Name name = scanner_.name();
    if (name.has_colon) return expand(name, start);
    if (name.prefix == "a") return type_;
    unknown_word(name.prefix, start);
  }

  Id object() {
    const char next = scanner_.peek();
    if (next == '<') return iri();
    if (next == '_') return labelled_blank();
    if (next == '(') return collection();
    if (next == '[') {
      bool empty = false;
      return blank_with_properties(empty);
    }
    if (is_quote(next)) return literal();
    if (is_digit(next) || next == '+' || next == '-' ||
        (next == '.' && is_digit(scanner_.peek(1)))) {
      return number();
    }
    if (!at_name()) expected("an object", "write an IRI, a literal, [ ... ] or ( ... )");
    const Position start = scanner_.position();
    const Scanner::Name name = scanner_.name();
    if (name.has_colon) return expand(name, start);
    if (name.prefix == "true" || name.prefix == "false") {
      return terms_.boolean(name.prefix == "true");
    }
    unknown_word(name.prefix, start);
  }

  // "[ ... ]"; `empty` tells whether it has no properties.
  Id blank_with_properties(bool& empty) {
    enter();
    scanner_.advance();
    const Id node = terms_.fresh_blank();
    scanner_.skip_space();
    empty = scanner_.accept(']');
    if (!empty) {
      predicates_and_objects(node);
      if (!scanner_.accept(']')) {
        expected("the end of a blank node", "close it with ], or go on with ; or ,");
      }
    }
    --nesting_;
    return node;
  }

  // "( ... )", as rdf:first and rdf:rest.
  Id collection() {
    enter();
    scanner_.advance();
    Id head;
    Id last;
    for (scanner_.skip_space(); !scanner_.accept(')'); scanner_.skip_space()) {
      if (scanner_.at_end()) expected("the end of a list", "close it with )");
      const Position place = scanner_.position();
      const Id cell = terms_.fresh_blank();
      if (last) {
        emit(last, rest_, cell, place);
      } else {
        head = cell;
      }
      emit(cell, first_, object(), place);
      last = cell;
    }
    if (last) emit(last, rest_, nil_, scanner_.position());
    --nesting_;
    return last ? head : nil_;
  }

  void enter() {
    if (++nesting_ <= kMaxNesting) return;
    scanner_.fail(fmt::format("[ ] and ( ) are nested more than {} deep", kMaxNesting),
                  "name some of the nodes with _:label and describe them one after another");
  }

  Id literal() {
    const std::string_view value = scanner_.string_literal();
    if (scanner_.peek() == '@') {
      // The tag points into the text, so the value is still there.
      const std::string_view tag = scanner_.language_tag();
      return terms_.literal(value, {}, tag);
    }
    if (scanner_.peek() != '^') return terms_.literal(value);
    value_.assign(value);
    if (scanner_.peek(1) != '^') expected("a literal's type", "write it as ^^<iri>");
    scanner_.advance(2);
    scanner_.skip_space();
    if (scanner_.peek() == '<') return terms_.literal(value_, iri());
    if (!at_name()) expected("a literal's type", "write it as ^^<iri> or ^^prefix:name");
    return terms_.literal(value_, prefixed_name());
  }

  Id number() {
    const Scanner::Number number = scanner_.number();
    switch (number.kind) {
      case Scanner::NumberKind::kInteger:
        return terms_.literal(number.text, integer_);
      case Scanner::NumberKind::kDecimal:
        return terms_.literal(number.text, decimal_);
      default:
        return terms_.literal(number.text, double_);
    }
  }

  Id labelled_blank() {
    if (scanner_.peek(1) != ':') expected("a node", "write a blank node as _:label");
    scanner_.advance(2);
    return blanks_.node(scanner_.blank_label());
  }

  Id iri() { return terms_.iri(iri_text()); }

  // At '<': the absolute IRI, in the text or in a buffer.
  std::string_view iri_text() {
    const Position start = scanner_.position();
    const std::string_view reference = scanner_.iri_reference();
    if (is_absolute_iri(reference)) return reference;
    auto resolved = resolve_iri(reference, base_);
    if (!resolved) {
      scanner_.fail(start, fmt::format("<{}> is relative and there is no base", reference),
                    "declare @base <iri> . before it, or write the IRI in full");
    }
    iri_ = std::move(*resolved);
    return iri_;
  }

  Id prefixed_name() {
    const Position start = scanner_.position();
    const Scanner::Name name = scanner_.name();
    if (!name.has_colon) unknown_word(name.prefix, start);
    return expand(name, start);
  }

  Id expand(const Scanner::Name& name, Position start) {
    const auto space = prefixes_.find(name.prefix);
    if (!space) {
      scanner_.fail(start, fmt::format("the prefix \"{}:\" is not declared", name.prefix),
                    fmt::format("declare @prefix {}: <iri> . before it", name.prefix));
    }
    iri_.assign(*space).append(name.local);
    return terms_.iri(iri_);
  }

  [[noreturn]] void unknown_word(std::string_view word, Position start) {
    if (word == "a") {
      scanner_.fail(start, "\"a\" stands where only a node can",
                    "it means rdf:type and can only be a predicate");
    }
    scanner_.fail(start, fmt::format("the word \"{}\" means nothing here", word),
                  "write a name with its prefix, or an IRI between < and >");
  }

  [[noreturn]] void expected(const char* what, const char* remedy) {
    scanner_.fail(fmt::format("there is {} where {} should be", scanner_.describe_next(), what),
                  remedy);
  }

  void expect_end(const char* what) {
    scanner_.skip_space();
    if (scanner_.accept('.')) return;
    scanner_.fail(fmt::format("there is {} where {} should end", scanner_.describe_next(), what),
                  "close it with a ., or go on with ; or ,");
  }

  // Whether a prefixed name or a word can begin here.
  bool at_name() const {
    const auto c = static_cast<unsigned char>(scanner_.peek());
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == ':' || c >= 0x80;
  }

  void emit(Id subject, Id predicate, Id object, Position place) {
    sink_({subject, predicate, object, graph_}, place.line, place.column);
  }

  Scanner scanner_;
  const bool graphs_;
  std::string base_;
  const Id unnamed_graph_;
  Id graph_;
  graph::Terms& terms_;
  const QuadSink& sink_;
  Prefixes prefixes_;
  BlankScope blanks_;
  std::size_t nesting_ = 0;
  std::string iri_;    // the IRI being put together
  std::string value_;  // a literal whose type is being read
  const Id type_, first_, rest_, nil_, integer_, decimal_, double_;
};

}  // namespace

Prefixes read_turtle(std::string_view text, bool graphs, const ReadOptions& options,
                     graph::Terms& terms, const QuadSink& sink) {
  return TurtleReader(text, graphs, options, terms, sink).read();
}

}  // namespace sinew::rdf
