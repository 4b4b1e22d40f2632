// Functions on texts by characters, not bytes (SPARQL 1.1, section 17.4.3). All texts are UTF-8.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sinew::rdf::sparql::values {

std::size_t character_count(std::string_view text);
// fn:substring: characters at positions p, from 1, with round(start) <= p < round(start) +
// round(length).
std::string_view substring(std::string_view text, double start, std::optional<double> length);
// Full Unicode mapping, of no language.
std::string upper_case(std::string_view text);
std::string lower_case(std::string_view text);
// Everything but letters and digits of ASCII and - _ . ~ becomes %XX.
std::string encode_for_uri(std::string_view text);
// RFC 4647, section 3.3.1; the range * matches every language.
bool language_matches(std::string_view language, std::string_view range);

struct CodeRange {
  char32_t first, last;
};
// A block of Unicode by its name as in regular expressions ("BasicLatin"), if there is one.
std::optional<CodeRange> unicode_block(std::string_view name);

}  // namespace sinew::rdf::sparql::values
