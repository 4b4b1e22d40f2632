#include "sinew/backend/json_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace sinew::backend {

namespace {

// Whether none of eight characters is a control character, a quotation mark or a backslash: the
// high bit of a byte of (x - n) & ~x is set where the lowest byte below n is (Mycroft, 1987).
bool eight_are_plain(const char* at) {
  constexpr std::uint64_t kOnes = 0x0101010101010101U, kHigh = 0x8080808080808080U;
  std::uint64_t x = 0;
  std::memcpy(&x, at, sizeof x);
  const auto below = [](std::uint64_t bytes, std::uint64_t n) {
    return (bytes - kOnes * n) & ~bytes;
  };
  const std::uint64_t found =
      below(x, 0x20) | below(x ^ kOnes * '"', 1) | below(x ^ kOnes * '\\', 1);
  return (found & kHigh) == 0;
}

void append_escaped(std::string& to, std::string_view text) {
  constexpr std::string_view kHexadecimal = "0123456789abcdef";
  std::size_t written = 0;  // what needs no escape is appended at once
  for (std::size_t k = 0; k < text.size(); ++k) {
    while (k + sizeof(std::uint64_t) <= text.size() && eight_are_plain(text.data() + k))
      k += sizeof(std::uint64_t);
    if (k == text.size()) break;
    const char c = text[k];
    const bool is_control = static_cast<unsigned char>(c) < 0x20;
    if (c != '"' && c != '\\' && !is_control) continue;
    to.append(text, written, k - written);
    written = k + 1;
    if (is_control) {
      to += "\\u00";
      to += kHexadecimal[static_cast<unsigned char>(c) >> 4U];
      to += kHexadecimal[static_cast<unsigned char>(c) & 15U];
    } else {
      to += '\\';
      to += c;
    }
  }
  to.append(text, written);
}

}  // namespace

// A comma, where something stands in front at the same level.
void JsonText::separate() {
  if (text_.empty()) return;
  const char last = text_.back();
  if (last != '{' && last != '[' && last != ':') text_ += ',';
}

JsonText& JsonText::begin_object() {
  separate();
  text_ += '{';
  return *this;
}
JsonText& JsonText::end_object() {
  text_ += '}';
  return *this;
}
JsonText& JsonText::begin_array() {
  separate();
  text_ += '[';
  return *this;
}
JsonText& JsonText::end_array() {
  text_ += ']';
  return *this;
}

JsonText& JsonText::key(std::string_view name) {
  separate();
  text_ += '"';
  text_ += name;
  text_ += "\":";
  return *this;
}

JsonText& JsonText::value(std::string_view text) {
  separate();
  text_ += '"';
  append_escaped(text_, text);
  text_ += '"';
  return *this;
}

JsonText& JsonText::value(double number) {
  separate();
  if (!std::isfinite(number)) {
    text_ += "null";
    return *this;
  }
  std::array<char, 32> digits = {};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  const std::string_view shortest(digits.data(), static_cast<std::size_t>(end - digits.data()));
  text_ += shortest;
  // A number with a fraction stays one for readers that tell integers from others.
  if (shortest.find_first_of(".e") == std::string_view::npos) text_ += ".0";
  return *this;
}

}  // namespace sinew::backend
