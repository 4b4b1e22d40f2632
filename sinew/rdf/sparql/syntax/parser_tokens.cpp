#include <fmt/format.h>

#include <algorithm>

#include "sinew/rdf/sparql/syntax/parser_class.h"

namespace sinew::rdf::sparql::syntax {
namespace {

std::shared_ptr<const Source> make_source(std::string_view text, const ParseOptions& options) {
  if (text.size() > options.limits.text_bytes) {
    throw Error(Problem{{options.name, 0, 0},
                        {},
                        fmt::format("the text has {} bytes, more than the limit of {}", text.size(),
                                    options.limits.text_bytes),
                        "split the text, or raise Limits::text_bytes",
                        Severity::kError,
                        {}});
  }
  return std::make_shared<const Source>(text, options.name);
}

}  // namespace

Parser::Parser(graph::Terms& terms, std::string_view text, const ParseOptions& options)
    : terms_(terms),
      options_(options),
      source_(make_source(text, options)),
      lexer_(*source_),
      base_(options.base) {
  if (options.prefixes) prefixes_ = *options.prefixes;
  lexer_.next(token_);
}

Parser::Level::Level(Parser& parser) : parser_(parser) {
  const std::size_t limit = std::min(parser.options_.limits.nesting, kMaximumNesting);
  if (parser.depth_ >= limit) {
    parser.fail(fmt::format("this is nested deeper than {} levels", limit),
                "split the query, or name parts of it with BIND");
  }
  ++parser.depth_;
}

void Parser::advance() {
  previous_end_ = token_.end;
  lexer_.next(token_);
}

bool Parser::accept(std::string_view punctuation) {
  if (!at(punctuation)) return false;
  advance();
  return true;
}

bool Parser::accept_word(std::string_view word) {
  if (!at_word(word)) return false;
  advance();
  return true;
}

void Parser::expect(std::string_view punctuation, std::string_view where) {
  if (accept(punctuation)) return;
  fail(fmt::format("{} stands where '{}' should {}", describe_token(), punctuation, where),
       fmt::format("write '{}' here", punctuation));
}

void Parser::expect_word(std::string_view word, std::string_view where) {
  if (accept_word(word)) return;
  fail(fmt::format("{} stands where {} should {}", describe_token(), word, where),
       fmt::format("write {} here", word));
}

std::string Parser::describe_token() const {
  if (token_.kind == TokenKind::kEnd) return "the end of the text";
  constexpr std::size_t kShown = 40;
  const std::string& text = source_->text();
  std::size_t length = std::min(token_.end - token_.offset, kShown);
  // Do not cut a character in two.
  while (token_.offset + length < text.size() && (text[token_.offset + length] & 0xC0) == 0x80) {
    ++length;
  }
  return fmt::format("'{}'", std::string_view(text).substr(token_.offset, length));
}

void Parser::fail(std::string what, std::string remedy) const {
  fail_at(token_.offset, std::move(what), std::move(remedy));
}

void Parser::fail_at(std::size_t offset, std::string what, std::string remedy) const {
  source_->fail(offset, std::move(what), std::move(remedy));
}

Query parse_query(graph::Terms& terms, std::string_view text, const ParseOptions& options) {
  return Parser(terms, text, options).query();
}

Update parse_update(graph::Terms& terms, std::string_view text, const ParseOptions& options) {
  return Parser(terms, text, options).update();
}

}  // namespace sinew::rdf::sparql::syntax
