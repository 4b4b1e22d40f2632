// The keywords of JSON-LD 1.1 (Syntax, section 1.7).
#pragma once

#include <string_view>

namespace sinew::jsonld {

namespace keyword {
inline constexpr std::string_view kBase = "@base";
inline constexpr std::string_view kContainer = "@container";
inline constexpr std::string_view kContext = "@context";
inline constexpr std::string_view kDirection = "@direction";
inline constexpr std::string_view kGraph = "@graph";
inline constexpr std::string_view kId = "@id";
inline constexpr std::string_view kImport = "@import";
inline constexpr std::string_view kIncluded = "@included";
inline constexpr std::string_view kIndex = "@index";
inline constexpr std::string_view kJson = "@json";
inline constexpr std::string_view kLanguage = "@language";
inline constexpr std::string_view kList = "@list";
inline constexpr std::string_view kNest = "@nest";
inline constexpr std::string_view kNone = "@none";
inline constexpr std::string_view kPrefix = "@prefix";
inline constexpr std::string_view kPropagate = "@propagate";
inline constexpr std::string_view kProtected = "@protected";
inline constexpr std::string_view kReverse = "@reverse";
inline constexpr std::string_view kSet = "@set";
inline constexpr std::string_view kType = "@type";
inline constexpr std::string_view kValue = "@value";
inline constexpr std::string_view kVersion = "@version";
inline constexpr std::string_view kVocab = "@vocab";
}  // namespace keyword

bool is_keyword(std::string_view text);

// "@" and letters: reserved for keywords to come, so such a text never means anything else.
bool has_keyword_form(std::string_view text);

}  // namespace sinew::jsonld
