#include "sinew/rdf/sparql/values/strings.h"

#include <algorithm>
#include <cmath>

namespace sinew::rdf::sparql::values {
namespace {

bool continues(char c) { return (c & 0xC0) == 0x80; }

// fn:round: half up.
double rounded(double value) { return std::floor(value + 0.5); }

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; };
    return lower(x) == lower(y);
  });
}

}  // namespace

std::size_t character_count(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return !continues(c); }));
}

std::string_view substring(std::string_view text, double start, std::optional<double> length) {
  const double begin = rounded(start);
  const double end = length ? begin + rounded(*length) : HUGE_VAL;
  // Comparisons with NaN are false: nothing is taken then.
  std::size_t from = text.size();
  std::size_t to = text.size();
  double position = 0;
  bool inside = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (continues(text[i])) continue;
    ++position;
    const bool wanted = position >= begin && position < end;
    if (wanted && !inside) {
      from = i;
      inside = true;
    } else if (!wanted && inside) {
      to = i;
      break;
    }
  }
  return text.substr(from, to - from);
}

std::string encode_for_uri(std::string_view text) {
  static constexpr char kHex[] = "0123456789ABCDEF";
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || c == '.' || c == '~';
    if (plain) {
      result += c;
    } else {
      result.append(1, '%').append(1, kHex[byte >> 4]).append(1, kHex[byte & 15]);
    }
  }
  return result;
}

bool language_matches(std::string_view language, std::string_view range) {
  if (range == "*") return !language.empty();
  if (language.size() == range.size()) return !range.empty() && same_letters(language, range);
  return !range.empty() && language.size() > range.size() && language[range.size()] == '-' &&
         same_letters(language.substr(0, range.size()), range);
}

}  // namespace sinew::rdf::sparql::values
