// Words of the block language, one at a time, since what a brace opens depends on what stands
// before it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/base/error.h"

namespace sinew::blocks {

struct Token {
  enum class Kind : std::uint8_t { kName, kInteger, kString, kMark, kEnd };
  Kind kind = Kind::kEnd;
  std::string text;        // a string without its quotes
  std::size_t offset = 0;  // where it begins
  std::size_t line = 1, column = 1;
  bool first_on_line = false;
};

class Lexer {
 public:
  // `text` must outlive the lexer. Throws Error for characters and strings that are no words.
  Lexer(std::string_view text, std::string file);

  const Token& peek() const { return token_; }
  Token next();
  // At "{": the text up to its "}", braces balanced, quotes respected; the next word is what
  // follows.
  std::string raw_block();
  // At a number, perhaps with a sign, a fraction and an exponent: its text.
  std::string number();

  Place place() const { return place_of(token_); }
  Place place_of(const Token& token) const { return {file_, token.line, token.column}; }
  [[noreturn]] void fail(const Place& place, std::string what, std::string remedy = {}) const;

  // Comments passed since the last call, with an empty text for blank lines; and the comment on the
  // last word's own line.
  std::vector<std::string> take_comments();
  std::string take_remark();

 private:
  void skip_spaces();
  void scan();

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0, line_ = 1, line_begin_ = 0;
  std::size_t last_line_ = 0;  // of the last word taken
  bool fresh_line_ = true;
  Token token_;
  std::vector<std::string> comments_;
  std::string remark_;
};

}  // namespace sinew::blocks
