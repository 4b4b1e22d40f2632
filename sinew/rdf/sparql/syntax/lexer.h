// Cuts a text into the terminals of SPARQL 1.1 (section 19.8), one at a time.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sinew/rdf/sparql/syntax/source.h"

namespace sinew::rdf::sparql::syntax {

enum class TokenKind : std::uint8_t {
  kEnd,
  kIri,         // text: what stands between < and >
  kName,        // a prefixed name; prefix and text (the local part, escapes replaced)
  kBlankLabel,  // text: after "_:"
  kVariable,    // text: without ? or $
  kLanguage,    // text: without @
  kInteger,
  kDecimal,
  kDouble,       // text: the digits as written, never with a sign
  kString,       // text: the value, escapes replaced
  kWord,         // text: in capitals; `word` as written
  kPunctuation,  // text: one of { } ( ) [ ] . ; , | / ^ ^^ * + - ? ! = != < > <= >= && ||
};

struct Token {
  TokenKind kind = TokenKind::kEnd;
  std::size_t offset = 0;  // of its first byte
  std::size_t end = 0;     // one behind its last byte
  std::string prefix;
  std::string text;
};

class Lexer {
 public:
  explicit Lexer(const Source& source) : source_(source), text_(source.text()) {}
  // Reads the next token into `token`, whose strings keep their memory.
  void next(Token& token);

 private:
  void skip_space();
  bool read_iri(Token& token);
  void read_name_or_word(Token& token);
  void read_local_name(Token& token);
  void read_blank_label(Token& token);
  bool read_variable(Token& token);
  void read_language(Token& token);
  void read_number(Token& token);
  void read_string(Token& token);
  void read_punctuation(Token& token);
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  const Source& source_;
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace sinew::rdf::sparql::syntax
