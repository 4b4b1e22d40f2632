#include "sinew/rdf/turtle/scanner.h"

#include <fmt/format.h>

#include "sinew/rdf/iri/characters.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/turtle/limits.h"

namespace sinew::rdf {
namespace {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Ends the run of characters that can be taken over as they are.
constexpr ByteClass kEndsIriRun = bytes_where([](unsigned char c) { return forbidden_in_iri(c); });
constexpr ByteClass kNameAscii = bytes_where([](unsigned char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
});

// Offset just behind the longest run of PN_CHARS, and '.' where it is followed by more of them.
std::size_t end_of_name(std::string_view text, std::size_t offset) {
  std::size_t end = offset;
  for (std::size_t i = offset; i < text.size();) {
    const char c = text[i];
    if (in(kNameAscii, c)) {
      end = ++i;
    } else if (c == '.') {
      ++i;
    } else {
      if (static_cast<unsigned char>(c) < 0x80) break;
      const Decoded next = decode_utf8(text, i);
      if (!is_name_character(next.character)) break;
      end = i += next.length;
    }
  }
  return end;
}

}  // namespace

Scanner::Scanner(std::string_view text, std::string_view file) : text_(text), file_(file) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  const std::size_t bad = first_invalid_utf8(text);
  if (bad != std::string_view::npos) {
    // Count up to the fault as if the text ended there.
    text_ = text.substr(0, bad);
    offset_ = bad;
    count_characters(0);
    fail(fmt::format("the byte 0x{:02X} is not UTF-8", static_cast<unsigned char>(text[bad])),
         "save the text as UTF-8");
  }
  if (text_.starts_with(kByteOrderMark)) {
    offset_ = line_start_ = kByteOrderMark.size();
  }
}

void Scanner::fail(Position position, std::string what, std::string remedy) const {
  throw Error(Problem{{file_, position.line, position.column},
                      "",
                      std::move(what),
                      std::move(remedy),
                      Severity::kError,
                      {}});
}

void Scanner::fail(std::string what, std::string remedy) const {
  fail(position(), std::move(what), std::move(remedy));
}

std::string Scanner::describe_next() const {
  if (at_end()) return "the end of the text";
  const Decoded next = decode_utf8(text_, offset_);
  if (next.character < 0x20 || next.character == 0x7F) {
    return next.character == '\n' || next.character == '\r'
               ? "the end of the line"
               : fmt::format("the control character 0x{:02X}", std::uint32_t{next.character});
  }
  return fmt::format("'{}'", text_.substr(offset_, next.length));
}

void Scanner::count_line_end() {
  // "\r\n" is one end of a line; the '\n' counts it.
  const bool counts = text_[offset_] == '\n' || peek(1) != '\n';
  ++offset_;
  if (counts) {
    ++line_;
    line_start_ = offset_;
  }
}

void Scanner::count_characters(std::size_t begin) {
  const std::size_t end = offset_;
  for (offset_ = begin; offset_ < end;) {
    const char c = text_[offset_];
    if (c == '\n' || c == '\r') {
      count_line_end();
    } else {
      if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) ++line_start_;
      ++offset_;
    }
  }
}

void Scanner::check_length(std::size_t bytes, Position start) const {
  if (bytes <= kMaxTermBytes) return;
  fail(start, fmt::format("a term is longer than {} bytes", kMaxTermBytes),
       "keep data of this size in a file of its own and refer to it");
}

bool Scanner::accept(char c) {
  if (peek() != c || at_end()) return false;
  ++offset_;
  return true;
}

void Scanner::skip_blanks() {
  while (peek() == ' ' || peek() == '\t') ++offset_;
}

bool Scanner::accept_line_end() {
  if (peek() == '\r') {
    count_line_end();
    if (peek() == '\n') count_line_end();
    return true;
  }
  if (peek() != '\n') return false;
  count_line_end();
  return true;
}

void Scanner::skip_comment() {
  if (peek() != '#') return;
  const std::size_t begin = offset_;
  while (!at_end() && peek() != '\n' && peek() != '\r') ++offset_;
  count_characters(begin);
}

void Scanner::skip_space() {
  while (true) {
    const char c = peek();
    if (c == ' ' || c == '\t') {
      ++offset_;
    } else if (c == '\n' || c == '\r') {
      count_line_end();
    } else if (c == '#') {
      skip_comment();
    } else {
      return;
    }
  }
}

void Scanner::skip_to(const ByteClass& ends) {
  unsigned char seen = 0;
  const std::size_t begin = offset_;
  while (!at_end() && !in(ends, text_[offset_])) {
    seen |= static_cast<unsigned char>(text_[offset_++]);
  }
  if (seen >= 0x80) count_characters(begin);
}

std::string_view Scanner::iri_reference() {
  const Position start = position();
  ++offset_;
  std::size_t begin = offset_;
  bool escaped = false;
  while (true) {
    skip_to(kEndsIriRun);
    if (accept('>')) break;
    if (peek() != '\\' || at_end()) {
      if (at_end()) fail(start, "an IRI does not end", "close it with >");
      fail(fmt::format("an IRI holds {}", peek() == ' ' ? "a space" : describe_next()),
           "percent-encode it, or close the IRI with > before it");
    }
    if (!escaped) buffer_.clear();
    escaped = true;
    buffer_.append(text_.substr(begin, offset_ - begin));
    const Position escape = position();
    ++offset_;
    if (peek() != 'u' && peek() != 'U') {
      fail(escape, "an IRI holds a \\ that is not \\u or \\U", "percent-encode it as %5C");
    }
    const char32_t character = unicode_escape();
    if (character < 0x80 && forbidden_in_iri(static_cast<unsigned char>(character))) {
      fail(escape,
           fmt::format("an escape stands for U+{:04X}, which no IRI may hold",
                       std::uint32_t{character}),
           "percent-encode the character");
    }
    append_utf8(buffer_, character);
    begin = offset_;
  }
  const std::string_view last = text_.substr(begin, offset_ - 1 - begin);
  check_length(last.size() + (escaped ? buffer_.size() : 0), start);
  if (!escaped) return last;
  buffer_.append(last);
  return buffer_;
}

std::string_view Scanner::blank_label() {
  const std::size_t begin = offset_;
  const Decoded first = decode_utf8(text_, offset_);
  if (!is_name_start(first.character) && !is_digit(peek())) {
    fail(fmt::format("a blank node's label begins with {}", describe_next()),
         "begin it with a letter, a digit or _");
  }
  offset_ = end_of_name(text_, offset_);
  const std::string_view label = text_.substr(begin, offset_ - begin);
  check_length(label.size(), position());
  count_characters(begin);
  return label;
}

std::string_view Scanner::language_tag() {
  const Position start = position();
  ++offset_;
  const std::size_t begin = offset_;
  while (in(kNameAscii, peek()) && peek() != '_') ++offset_;
  const std::string_view tag = text_.substr(begin, offset_ - begin);
  if (!is_language_tag(tag)) {
    fail(start, fmt::format("\"{}\" is not a language tag", tag),
         "write letters, then groups of letters and digits, each after a -");
  }
  return tag;
}

Scanner::Number Scanner::number() {
  const std::size_t begin = offset_;
  NumberKind kind = NumberKind::kInteger;
  if (peek() == '+' || peek() == '-') ++offset_;
  const std::size_t whole = offset_;
  while (is_digit(peek())) ++offset_;
  const bool has_whole = offset_ > whole;

  const auto exponent_at = [&](std::size_t ahead) {
    if (peek(ahead) != 'e' && peek(ahead) != 'E') return false;
    if (peek(ahead + 1) == '+' || peek(ahead + 1) == '-') ++ahead;
    return is_digit(peek(ahead + 1));
  };
  // A '.' belongs to the number only if digits or an exponent follow: "1." is 1 and an end.
  if (peek() == '.' && (is_digit(peek(1)) || (has_whole && exponent_at(1)))) {
    kind = NumberKind::kDecimal;
    ++offset_;
    while (is_digit(peek())) ++offset_;
  } else if (!has_whole) {
    fail(fmt::format("a number has {} instead of a digit", describe_next()),
         "write a number such as 1, -0.5 or 2e-3");
  }
  if (exponent_at(0)) {
    kind = NumberKind::kDouble;
    offset_ += 2;
    while (is_digit(peek())) ++offset_;
  }
  return {text_.substr(begin, offset_ - begin), kind};
}

std::string_view Scanner::local_name() {
  const Position start = position();
  std::size_t begin = offset_;
  bool escaped = false;
  bool first = true;
  std::size_t dots = 0;  // at the end so far; they belong to the name only if more follows
  while (true) {
    const char c = peek();
    if (in(kNameAscii, c) || c == ':') {
      if (first && c == '-') break;
      ++offset_;
    } else if (c == '.' && !first) {
      ++offset_;
      ++dots;
      continue;
    } else if (c == '%') {
      if (hex_digit_value(peek(1)) < 0 || hex_digit_value(peek(2)) < 0) {
        fail("a name has % without two hexadecimal digits", "write \\% for the character itself");
      }
      offset_ += 3;
    } else if (c == '\\') {
      if (!is_local_escape(peek(1))) {
        fail("a name has \\ before a character that takes no escape",
             "write the IRI in full, between < and >");
      }
      if (!escaped) buffer_.clear();
      escaped = true;
      buffer_.append(text_.substr(begin, offset_ - begin));
      begin = ++offset_;  // the escaped character is taken over with what follows
      ++offset_;
    } else {
      if (static_cast<unsigned char>(c) < 0x80) break;
      const Decoded next = decode_utf8(text_, offset_);
      if (!(first ? is_name_start(next.character) : is_name_character(next.character))) break;
      offset_ += next.length;
      line_start_ += next.length - 1;
    }
    dots = 0;
    first = false;
  }
  offset_ -= dots;
  const std::string_view last = text_.substr(begin, offset_ - begin);
  check_length(last.size() + (escaped ? buffer_.size() : 0), start);
  if (!escaped) return last;
  buffer_.append(last);
  return buffer_;
}

Scanner::Name Scanner::name() {
  Name name;
  if (peek() != ':') {
    const std::size_t begin = offset_;
    const Decoded first = decode_utf8(text_, offset_);
    if (!is_name_base(first.character)) {
      fail(fmt::format("there is {} where a name should begin", describe_next()),
           "begin it with a letter");
    }
    offset_ = end_of_name(text_, offset_);
    name.prefix = text_.substr(begin, offset_ - begin);
    check_length(name.prefix.size(), position());
    count_characters(begin);
  }
  if (!accept(':')) return name;
  name.has_colon = true;
  name.local = local_name();
  return name;
}

}  // namespace sinew::rdf
