#include "sinew/rdf/sparql/syntax/lexer.h"

#include <fmt/format.h>

#include "sinew/rdf/iri/characters.h"
#include "sinew/rdf/iri/iri.h"

namespace sinew::rdf::sparql::syntax {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_word_character(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

}  // namespace

void Lexer::skip_space() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c == '#') {
      while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
    } else if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
      ++at_;
    } else {
      return;
    }
  }
}

void Lexer::next(Token& token) {
  skip_space();
  token.offset = at_;
  token.text.clear();
  token.prefix.clear();
  if (at_ >= text_.size()) {
    token.kind = TokenKind::kEnd;
    token.end = at_;
    return;
  }
  const char c = text_[at_];
  if (c == '<' && read_iri(token)) {
  } else if ((c == '?' || c == '$') && read_variable(token)) {
  } else if (c == '"' || c == '\'') {
    read_string(token);
  } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
    read_number(token);
  } else if (c == '_' && peek(1) == ':') {
    read_blank_label(token);
  } else if (c == '@') {
    read_language(token);
  } else if (is_letter(c) || c == ':' || (c & 0x80) != 0) {
    read_name_or_word(token);
  } else {
    read_punctuation(token);
  }
  token.end = at_;
}

// '<' also means "less than"; it opens an IRI when a '>' follows before any character that no IRI
// holds.
bool Lexer::read_iri(Token& token) {
  std::size_t end = at_ + 1;
  while (end < text_.size() && text_[end] != '>') {
    if (forbidden_in_iri(static_cast<unsigned char>(text_[end])) && text_[end] != '\x7F') {
      return false;
    }
    ++end;
  }
  if (end >= text_.size()) return false;
  token.kind = TokenKind::kIri;
  token.text.assign(text_, at_ + 1, end - at_ - 1);
  at_ = end + 1;
  return true;
}

bool Lexer::read_variable(Token& token) {
  std::size_t end = at_ + 1;
  while (end < text_.size()) {
    if (is_word_character(text_[end])) {
      ++end;
      continue;
    }
    const Decoded next = decode_utf8(text_, end);
    if (next.length < 2 || !is_name_character(next.character)) break;
    // Digits and combining marks beyond ASCII may not come first.
    if (end == at_ + 1 && !is_name_start(next.character)) break;
    end += next.length;
  }
  if (end == at_ + 1) return false;
  token.kind = TokenKind::kVariable;
  token.text.assign(text_, at_ + 1, end - at_ - 1);
  at_ = end;
  return true;
}

void Lexer::read_language(Token& token) {
  const std::size_t begin = at_ + 1;
  std::size_t end = begin;
  while (end < text_.size() &&
         (is_letter(text_[end]) || is_digit(text_[end]) || text_[end] == '-')) {
    ++end;
  }
  token.kind = TokenKind::kLanguage;
  token.text.assign(text_, begin, end - begin);
  if (!is_language_tag(token.text)) {
    source_.fail(at_, "there is no language tag after @", "write for example \"text\"@en");
  }
  at_ = end;
}

void Lexer::read_blank_label(Token& token) {
  const std::size_t begin = at_ + 2;
  std::size_t end = begin;
  std::size_t last = begin;  // one behind the last character that may end a label
  while (end < text_.size()) {
    const Decoded next = decode_utf8(text_, end);
    const bool first_ok = is_name_start(next.character) || is_digit(text_[end]);
    if (end == begin ? !first_ok : !is_name_character(next.character) && next.character != '.')
      break;
    end += next.length;
    if (next.character != '.') last = end;
  }
  if (last == begin) {
    source_.fail(at_, "there is no label after _:", "write for example _:a, or [] without a label");
  }
  token.kind = TokenKind::kBlankLabel;
  token.text.assign(text_, begin, last - begin);
  at_ = last;
}

// A prefix and a word begin alike; the ':' behind it decides.
void Lexer::read_name_or_word(Token& token) {
  std::size_t end = at_;
  std::size_t last = at_;
  while (end < text_.size() && text_[end] != ':') {
    const Decoded next = decode_utf8(text_, end);
    const bool ok = end == at_ ? is_name_base(next.character)
                               : is_name_character(next.character) || next.character == '.';
    if (!ok) break;
    end += next.length;
    if (next.character != '.') last = end;
  }
  if (end < text_.size() && text_[end] == ':' && (last == end)) {
    token.kind = TokenKind::kName;
    token.prefix.assign(text_, at_, end - at_);
    at_ = end + 1;
    read_local_name(token);
    return;
  }
  end = at_;
  while (end < text_.size() && is_word_character(text_[end])) ++end;
  if (end == at_) {
    source_.fail(at_, "this character begins no word of the language",
                 "put names into <...> or give them a prefix, and text into quotes");
  }
  token.kind = TokenKind::kWord;
  token.text.assign(text_, at_, end - at_);
  if (token.text != "a") {
    for (char& c : token.text) {
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
  }
  at_ = end;
}

void Lexer::read_local_name(Token& token) {
  bool first = true;
  std::size_t dots = 0;  // a name does not end with dots, so they wait for what follows
  while (at_ + dots < text_.size()) {
    const std::size_t at = at_ + dots;
    const char c = text_[at];
    std::size_t length = 0;
    std::size_t skip = 0;
    if (c == '.' && !first) {
      ++dots;
      continue;
    }
    if (c == '%') {
      if (at + 2 >= text_.size() ||
          hex_digit_value(static_cast<unsigned char>(text_[at + 1])) < 0 ||
          hex_digit_value(static_cast<unsigned char>(text_[at + 2])) < 0) {
        source_.fail(at, "% in a name needs two hexadecimal digits",
                     "write \\% for the sign itself");
      }
      length = 3;
    } else if (c == '\\') {
      if (at + 1 >= text_.size() || !is_local_escape(text_[at + 1])) {
        source_.fail(at, "this character cannot be escaped in a name",
                     "write the whole IRI in <...>");
      }
      length = 1;
      skip = 1;
    } else if (c == ':') {
      length = 1;
    } else {
      const Decoded next = decode_utf8(text_, at);
      const bool ok =
          first ? is_name_start(next.character) || is_digit(c) : is_name_character(next.character);
      if (!ok) break;
      length = next.length;
    }
    token.text.append(dots, '.');
    token.text.append(text_, at + skip, length);
    at_ = at + skip + length;
    dots = 0;
    first = false;
  }
}

void Lexer::read_number(Token& token) {
  const std::size_t begin = at_;
  token.kind = TokenKind::kInteger;
  while (is_digit(peek())) ++at_;
  const auto exponent_at = [&](std::size_t ahead) {
    if (peek(ahead) != 'e' && peek(ahead) != 'E') return false;
    const bool sign = peek(ahead + 1) == '+' || peek(ahead + 1) == '-';
    return is_digit(peek(ahead + (sign ? 2 : 1)));
  };
  // "1." is the number 1 and the end of a triple, but "1.e5" is a double.
  if (peek() == '.' && (is_digit(peek(1)) || (at_ > begin && exponent_at(1)))) {
    token.kind = TokenKind::kDecimal;
    ++at_;
    while (is_digit(peek())) ++at_;
  }
  if (exponent_at(0)) {
    token.kind = TokenKind::kDouble;
    at_ += 2;
    while (is_digit(peek())) ++at_;
  }
  token.text.assign(text_, begin, at_ - begin);
}

void Lexer::read_string(Token& token) {
  const char quote = text_[at_];
  const bool is_long = peek(1) == quote && peek(2) == quote;
  const std::size_t begin = at_;
  at_ += is_long ? 3 : 1;
  token.kind = TokenKind::kString;
  while (true) {
    if (at_ >= text_.size()) {
      source_.fail(begin, "this string does not end", fmt::format("close it with {}", quote));
    }
    const char c = text_[at_];
    if (c == quote && (!is_long || (peek(1) == quote && peek(2) == quote))) break;
    if (!is_long && (c == '\n' || c == '\r')) {
      source_.fail(begin, "this string does not end on its line",
                   "close it, or use three quotes for text of several lines");
    }
    if (c != '\\') {
      token.text += c;
      ++at_;
      continue;
    }
    static constexpr std::string_view kEscapes = "tbnrf\\\"'";
    static constexpr std::string_view kMeanings = "\t\b\n\r\f\\\"'";
    const std::size_t which = kEscapes.find(peek(1));
    if (at_ + 1 >= text_.size() || which == std::string_view::npos) {
      source_.fail(at_, "there is no such escape in a string",
                   "the escapes are \\t \\b \\n \\r \\f \\\\ \\\" \\'");
    }
    token.text += kMeanings[which];
    at_ += 2;
  }
  at_ += is_long ? 3 : 1;
}

void Lexer::read_punctuation(Token& token) {
  static constexpr std::string_view kTwo[] = {"^^", "!=", "<=", ">=", "&&", "||"};
  static constexpr std::string_view kOne = "{}()[].;,|/^*+-?!=<>";
  token.kind = TokenKind::kPunctuation;
  for (const std::string_view two : kTwo) {
    if (text_.substr(at_, 2) == two) {
      token.text = two;
      at_ += 2;
      return;
    }
  }
  if (kOne.find(text_[at_]) == std::string_view::npos) {
    source_.fail(at_, fmt::format("the character '{}' means nothing here", text_[at_]),
                 "remove it, or put text into quotes");
  }
  token.text = text_[at_++];
}

}  // namespace sinew::rdf::sparql::syntax
