#include "sinew/rdf/sparql/syntax/source.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/rdf/iri/characters.h"

namespace sinew::rdf::sparql::syntax {
namespace {

// The value of `digits` hexadecimal digits at `offset`, or -1.
std::int64_t hex_value(std::string_view text, std::size_t offset, std::size_t digits) {
  if (text.size() < offset + digits) return -1;
  std::int64_t value = 0;
  for (std::size_t i = offset; i < offset + digits; ++i) {
    const int digit = hex_digit_value(static_cast<unsigned char>(text[i]));
    if (digit < 0) return -1;
    value = value * 16 + digit;
  }
  return value;
}

}  // namespace

Source::Source(std::string_view text, std::string name)
    : text_(text), name_(name.empty() ? "query" : std::move(name)) {
  const std::size_t invalid = first_invalid_utf8(text);
  if (invalid != std::string_view::npos) {
    fail(invalid, "the text is not UTF-8", "encode the text as UTF-8");
  }
  if (text.find("\\u") == std::string_view::npos && text.find("\\U") == std::string_view::npos) {
    return;
  }
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const bool is_escape = text[i] == '\\' && i + 1 < text.size();
    if (!is_escape || (text[i + 1] != 'u' && text[i + 1] != 'U')) {
      const std::size_t length = is_escape ? 2 : 1;
      decoded.append(text, i, length);
      i += length;
      continue;
    }
    const std::size_t digits = text[i + 1] == 'u' ? 4 : 8;
    const std::int64_t value = hex_value(text, i + 2, digits);
    if (value < 0 || value > 0x10FFFF || !is_scalar_value(static_cast<char32_t>(value))) {
      fail(i, "this escape stands for no character",
           "write \\u and 4, or \\U and 8 hexadecimal digits of a character that is no surrogate");
    }
    append_utf8(decoded, static_cast<char32_t>(value));
    i += 2 + digits;
  }
  text_ = std::move(decoded);
}

Place Source::place(std::size_t offset) const {
  const std::string_view before = std::string_view(text_).substr(0, std::min(offset, text_.size()));
  const std::size_t lines =
      static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 == 0
  // Columns count characters: every byte that does not continue one.
  const auto column = std::count_if(before.begin() + static_cast<std::ptrdiff_t>(line_start),
                                    before.end(), [](char c) { return (c & 0xC0) != 0x80; });
  return {name_, lines + 1, static_cast<std::size_t>(column) + 1};
}

void Source::fail(std::size_t offset, std::string what, std::string remedy) const {
  Place where = place(offset);
  Problem problem;
  // The printed form of a Place stops at the line; the column belongs to the message as well.
  problem.what = fmt::format("column {}: {}", where.column, what);
  problem.place = std::move(where);
  problem.remedy = std::move(remedy);
  throw Error(std::move(problem));
}

}  // namespace sinew::rdf::sparql::syntax
