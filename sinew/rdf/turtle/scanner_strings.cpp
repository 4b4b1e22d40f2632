// String literals and escapes.
#include <fmt/format.h>

#include "sinew/rdf/iri/characters.h"
#include "sinew/rdf/turtle/scanner.h"

namespace sinew::rdf {
namespace {

// Ends the run of characters that can be taken over as they are.
constexpr ByteClass kEndsStringRun = bytes_where(
    [](unsigned char c) { return c == '"' || c == '\'' || c == '\\' || c == '\n' || c == '\r'; });

}  // namespace

// At the 'u' or 'U' of an escape.
char32_t Scanner::unicode_escape() {
  const Position start = position();
  const int digits = peek() == 'u' ? 4 : 8;
  ++offset_;
  char32_t character = 0;
  for (int i = 0; i < digits; ++i) {
    const int value = hex_digit_value(peek());
    if (value < 0) {
      fail(fmt::format("an escape has {} instead of a hexadecimal digit", describe_next()),
           "write \\u and 4 digits, or \\U and 8");
    }
    character = character << 4 | static_cast<char32_t>(value);
    ++offset_;
  }
  if (!is_scalar_value(character)) {
    fail(start, fmt::format("U+{:04X} is not a character", std::uint32_t{character}),
         "escape the character itself, not a half of its UTF-16 form");
  }
  return character;
}

// At the '\'.
void Scanner::string_escape() {
  const Position start = position();
  ++offset_;
  if (const char control = control_of_escape(peek())) {
    buffer_ += control;
    ++offset_;
    return;
  }
  switch (peek()) {
    case '"':
    case '\'':
    case '\\':
      buffer_ += peek();
      break;
    case 'u':
    case 'U':
      append_utf8(buffer_, unicode_escape());
      return;
    default:
      fail(start, fmt::format("a string has \\ before {}", describe_next()),
           "escapes are \\t \\b \\n \\r \\f \\\" \\' \\\\ \\uXXXX \\UXXXXXXXX");
  }
  ++offset_;
}

std::string_view Scanner::short_string(char quote) {
  const Position start = position();
  ++offset_;
  std::size_t begin = offset_;
  bool escaped = false;
  while (true) {
    skip_to(kEndsStringRun);
    if (at_end()) fail(start, "a string does not end", fmt::format("close it with {}", quote));
    const char c = text_[offset_];
    if (c == quote) break;
    if (c == '\n' || c == '\r') {
      fail(start, "a string does not end on its line",
           fmt::format("close it with {}, or write \\n for an end of line", quote));
    }
    if (c == '\\') {
      if (!escaped) buffer_.clear();
      escaped = true;
      buffer_.append(text_.substr(begin, offset_ - begin));
      string_escape();
      begin = offset_;
    } else {
      ++offset_;  // the other kind of quote
    }
  }
  const std::string_view last = text_.substr(begin, offset_ - begin);
  ++offset_;
  check_length(last.size() + (escaped ? buffer_.size() : 0), start);
  if (!escaped) return last;
  buffer_.append(last);
  return buffer_;
}

std::string_view Scanner::long_string(char quote) {
  const Position start = position();
  offset_ += 3;
  std::size_t begin = offset_;
  bool escaped = false;
  while (true) {
    if (at_end()) {
      fail(start, "a string does not end", fmt::format("close it with {0}{0}{0}", quote));
    }
    const char c = text_[offset_];
    if (c == quote && peek(1) == quote && peek(2) == quote) break;
    if (c == '\\') {
      if (!escaped) buffer_.clear();
      escaped = true;
      buffer_.append(text_.substr(begin, offset_ - begin));
      string_escape();
      begin = offset_;
    } else if (c == '\n' || c == '\r') {
      count_line_end();
    } else {
      if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) ++line_start_;
      ++offset_;
    }
  }
  const std::string_view last = text_.substr(begin, offset_ - begin);
  offset_ += 3;
  check_length(last.size() + (escaped ? buffer_.size() : 0), start);
  if (!escaped) return last;
  buffer_.append(last);
  return buffer_;
}

std::string_view Scanner::string_literal() {
  const char quote = peek();
  return peek(1) == quote && peek(2) == quote ? long_string(quote) : short_string(quote);
}

std::string_view Scanner::short_string() { return short_string('"'); }

}  // namespace sinew::rdf
