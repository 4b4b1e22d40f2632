#include "sinew/rdf/iri/characters.h"

#include <array>
#include <cstring>

namespace sinew::rdf {
namespace {

bool is_continuation(unsigned char byte) { return (byte & 0xC0) == 0x80; }

bool is_ascii_letter(char32_t c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_ascii_digit(char32_t c) { return c >= '0' && c <= '9'; }

// Bytes of the well-formed sequence at the start of `text` (Unicode, table 3-7), 0 if there is
// none.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  const std::size_t length = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  if (text.size() < length) return 0;
  // The second byte rules out overlong forms, surrogates and values that are too large.
  const unsigned char low = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
  const unsigned char high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
  if (byte(1) < low || byte(1) > high) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if (!is_continuation(byte(i))) return 0;
  }
  return length;
}

struct Range {
  char32_t first, last;
};
// PN_CHARS_BASE beyond ASCII.
constexpr std::array<Range, 12> kNameBase = {{{0xC0, 0xD6},
                                              {0xD8, 0xF6},
                                              {0xF8, 0x2FF},
                                              {0x370, 0x37D},
                                              {0x37F, 0x1FFF},
                                              {0x200C, 0x200D},
                                              {0x2070, 0x218F},
                                              {0x2C00, 0x2FEF},
                                              {0x3001, 0xD7FF},
                                              {0xF900, 0xFDCF},
                                              {0xFDF0, 0xFFFD},
                                              {0x10000, 0xEFFFF}}};

}  // namespace

std::size_t first_invalid_utf8(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    // Eight ASCII bytes at a time: most of every document.
    std::uint64_t word;
    if (i + sizeof word <= text.size()) {
      std::memcpy(&word, text.data() + i, sizeof word);
      if ((word & 0x8080808080808080ull) == 0) {
        i += sizeof word;
        continue;
      }
    }
    const std::size_t length = sequence_length(text.substr(i));
    if (length == 0) return i;
    i += length;
  }
  return std::string_view::npos;
}

Decoded decode_utf8(std::string_view text, std::size_t offset) {
  if (offset >= text.size()) return {};
  const auto byte = [&](std::size_t i) {
    return static_cast<char32_t>(static_cast<unsigned char>(text[offset + i]));
  };
  const char32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  if (lead < 0xE0) return {(lead & 0x1F) << 6 | (byte(1) & 0x3F), 2};
  if (lead < 0xF0) {
    return {(lead & 0x0F) << 12 | (byte(1) & 0x3F) << 6 | (byte(2) & 0x3F), 3};
  }
  return {(lead & 0x07) << 18 | (byte(1) & 0x3F) << 12 | (byte(2) & 0x3F) << 6 | (byte(3) & 0x3F),
          4};
}

void append_utf8(std::string& out, char32_t c) {
  const auto put = [&](char32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | c >> 6);
    put(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    put(0xE0 | c >> 12);
    put(0x80 | (c >> 6 & 0x3F));
    put(0x80 | (c & 0x3F));
  } else {
    put(0xF0 | c >> 18);
    put(0x80 | (c >> 12 & 0x3F));
    put(0x80 | (c >> 6 & 0x3F));
    put(0x80 | (c & 0x3F));
  }
}

bool is_name_base(char32_t c) {
  if (c < 0x80) return is_ascii_letter(c);
  for (const Range& range : kNameBase) {
    if (c <= range.last) return c >= range.first;
  }
  return false;
}

bool is_name_character(char32_t c) {
  if (c < 0x80) return is_ascii_letter(c) || is_ascii_digit(c) || c == '_' || c == '-';
  return is_name_base(c) || c == 0xB7 || (c >= 0x300 && c <= 0x36F) || c == 0x203F || c == 0x2040;
}

bool is_local_escape(char c) {
  return c != '\0' && std::strchr("_~.-!$&'()*+,;=/?#@%", c) != nullptr;
}

bool is_plain_local_name(std::string_view name) {
  if (name.empty()) return true;
  if (name.back() == '.') return false;
  std::size_t i = 0;
  while (i < name.size()) {
    const Decoded next = decode_utf8(name, i);
    const char32_t c = next.character;
    if (c == '%') {
      if (i + 2 >= name.size() || hex_digit_value(name[i + 1]) < 0 ||
          hex_digit_value(name[i + 2]) < 0) {
        return false;
      }
    } else if (i == 0) {
      if (!is_name_start(c) && c != ':' && !is_ascii_digit(c)) return false;
    } else if (!is_name_character(c) && c != ':' && c != '.') {
      return false;
    }
    i += next.length;
  }
  return true;
}

bool is_prefix_name(std::string_view name) {
  if (name.empty()) return true;
  if (name.back() == '.' || !is_name_base(decode_utf8(name, 0).character)) return false;
  for (std::size_t i = 0; i < name.size();) {
    const Decoded next = decode_utf8(name, i);
    if (!is_name_character(next.character) && next.character != '.') return false;
    i += next.length;
  }
  return true;
}

bool is_blank_label(std::string_view label) {
  if (label.empty() || label.back() == '.') return false;
  const char32_t first = decode_utf8(label, 0).character;
  if (!is_name_start(first) && !is_ascii_digit(first)) return false;
  for (std::size_t i = 0; i < label.size();) {
    const Decoded next = decode_utf8(label, i);
    if (!is_name_character(next.character) && next.character != '.') return false;
    i += next.length;
  }
  return true;
}

bool is_language_tag(std::string_view tag) {
  bool first_group = true;
  while (true) {
    const std::size_t dash = tag.find('-');
    const std::string_view group = tag.substr(0, dash);
    if (group.empty()) return false;
    for (const char c : group) {
      const auto character = static_cast<unsigned char>(c);
      if (!is_ascii_letter(character) && (first_group || !is_ascii_digit(character))) return false;
    }
    if (dash == std::string_view::npos) return true;
    first_group = false;
    tag.remove_prefix(dash + 1);
  }
}

}  // namespace sinew::rdf
