// UTF-8, and the classes of characters from which Turtle, N-Quads and SPARQL build their names. The
// grammars share these productions (Turtle, section 6.5; SPARQL, section 19.8).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sinew::rdf {

// Offset of the first byte that is not strict UTF-8 (RFC 3629: no overlong forms, no surrogates,
// nothing above U+10FFFF), or npos when the whole text is.
std::size_t first_invalid_utf8(std::string_view text);

struct Decoded {
  char32_t character = 0;
  std::uint32_t length = 0;  // bytes; 0 at the end of the text
};
// The character at `offset` of a text that is known to be UTF-8.
Decoded decode_utf8(std::string_view text, std::size_t offset);

// Precondition: is_scalar_value(character).
void append_utf8(std::string& out, char32_t character);

constexpr bool is_scalar_value(char32_t character) {
  return character <= 0x10FFFF && !(character >= 0xD800 && character <= 0xDFFF);
}

// What \b, \t, \n, \f and \r stand for in strings of JSON, Turtle and SPARQL; 0 for other letters.
constexpr char control_of_escape(char letter) {
  return letter == 'b'   ? '\b'
         : letter == 't' ? '\t'
         : letter == 'n' ? '\n'
         : letter == 'f' ? '\f'
         : letter == 'r' ? '\r'
                         : '\0';
}

// 0 to 15, or -1 when it is not a hexadecimal digit.
constexpr int hex_digit_value(char32_t c) {
  if (c >= '0' && c <= '9') return static_cast<int>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<int>(c - 'a') + 10;
  if (c >= 'A' && c <= 'F') return static_cast<int>(c - 'A') + 10;
  return -1;
}

// PN_CHARS_BASE: a letter in the widest sense.
bool is_name_base(char32_t character);
// PN_CHARS_U: the same and '_'.
inline bool is_name_start(char32_t character) {
  return character == '_' || is_name_base(character);
}
// PN_CHARS: the same, '-', digits and combining marks.
bool is_name_character(char32_t character);

// Characters that may follow a '\' in the local part of a prefixed name (PN_LOCAL_ESC).
bool is_local_escape(char character);

// True when `name` can stand after "prefix:" as it is, without escapes (PN_LOCAL); so is the empty
// name.
bool is_plain_local_name(std::string_view name);
// True when `name` can be a prefix (PN_PREFIX); so is the empty name.
bool is_prefix_name(std::string_view name);
// True when `label` can follow "_:" (BLANK_NODE_LABEL).
bool is_blank_label(std::string_view label);
// True for letters, then groups of letters and digits, each after a '-' (LANGTAG without the '@').
bool is_language_tag(std::string_view tag);

}  // namespace sinew::rdf
