// Reads the terms that Turtle, TriG, N-Triples, N-Quads and SPARQL share from a text, one at a
// time, and keeps track of the place. There is no list of tokens: a parser looks at the next
// character and calls the function for the term that begins with it.
//
// Every view that a function returns is valid until the next call; it points into the text, or into
// the scanner's own buffer when escapes had to be replaced. Faults throw Error with place and
// remedy.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/rdf/turtle/byte_class.h"

namespace sinew::rdf {

class Scanner {
 public:
  struct Position {
    std::size_t line = 1, column = 1;
  };

  // The text must outlive the scanner. Throws Error when it is not strict UTF-8; a byte order mark
  // at its beginning is passed over.
  Scanner(std::string_view text, std::string_view file);

  bool at_end() const { return offset_ >= text_.size(); }
  // The byte at the present place, or further ahead; '\0' beyond the end.
  char peek(std::size_t ahead = 0) const {
    return offset_ + ahead < text_.size() ? text_[offset_ + ahead] : '\0';
  }
  Position position() const { return {line_, offset_ - line_start_ + 1}; }
  std::size_t offset() const { return offset_; }
  std::string_view text() const { return text_; }

  // Passes over ASCII characters that are known not to end a line.
  void advance(std::size_t count = 1) { offset_ += count; }
  // Passes over `c` if it is next.
  bool accept(char c);
  void skip_space();       // white space, ends of lines, comments
  void skip_blanks();      // spaces and tabs
  bool accept_line_end();  // "\n", "\r\n" or "\r"; false when there is none here
  void skip_comment();     // from '#' up to the end of the line, if there is one here

  // <...>, at '<': the text between the brackets, escapes replaced. Not resolved, not checked for a
  // scheme, but free of characters that no IRI may hold.
  std::string_view iri_reference();
  // "...", '...', """...""" or '''...''', at a quote: the value.
  std::string_view string_literal();
  // "..." alone, as in N-Triples.
  std::string_view short_string();
  // After "_:".
  std::string_view blank_label();
  // At '@': the tag, which begins with a letter.
  std::string_view language_tag();

  enum class NumberKind { kInteger, kDecimal, kDouble };
  struct Number {
    std::string_view text;
    NumberKind kind;
  };
  // At a sign, a digit or a '.'.
  Number number();

  // A name without a colon is a word, such as a keyword.
  struct Name {
    std::string_view prefix, local;
    bool has_colon = false;
  };
  // At a letter or ':'. Escapes in the local part are replaced.
  Name name();

  [[noreturn]] void fail(Position position, std::string what, std::string remedy) const;
  [[noreturn]] void fail(std::string what, std::string remedy) const;
  // The next character in quotes, or "the end of the text"; for messages.
  std::string describe_next() const;

 private:
  // Passes over what can be taken over as it is, to the next character of `ends` or the end of the
  // text. No end of a line may be passed over.
  void skip_to(const ByteClass& ends);
  // Counts lines and characters of what lies between `begin` and the present place.
  void count_characters(std::size_t begin);
  void count_line_end();  // at '\n' or '\r', which it passes over
  char32_t unicode_escape();
  void check_length(std::size_t bytes, Position start) const;
  std::string_view short_string(char quote);
  std::string_view long_string(char quote);
  void string_escape();
  std::string_view local_name();

  std::string_view text_;
  std::string file_;
  std::size_t offset_ = 0;
  std::size_t line_ = 1;
  // Where the line would begin if each of its characters so far were one byte.
  std::size_t line_start_ = 0;
  std::string buffer_;
};

}  // namespace sinew::rdf
