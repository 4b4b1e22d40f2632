#include "sinew/rdf/jsonld/keywords.h"

#include <algorithm>
#include <array>

namespace sinew::jsonld {
namespace {

constexpr std::array kKeywords = {
    keyword::kBase,      keyword::kContainer, keyword::kContext,  keyword::kDirection,
    keyword::kGraph,     keyword::kId,        keyword::kImport,   keyword::kIncluded,
    keyword::kIndex,     keyword::kJson,      keyword::kLanguage, keyword::kList,
    keyword::kNest,      keyword::kNone,      keyword::kPrefix,   keyword::kPropagate,
    keyword::kProtected, keyword::kReverse,   keyword::kSet,      keyword::kType,
    keyword::kValue,     keyword::kVersion,   keyword::kVocab};

}  // namespace

bool is_keyword(std::string_view text) {
  if (text.empty() || text.front() != '@') return false;
  return std::find(kKeywords.begin(), kKeywords.end(), text) != kKeywords.end();
}

bool has_keyword_form(std::string_view text) {
  if (text.size() < 2 || text.front() != '@') return false;
  return std::all_of(text.begin() + 1, text.end(),
                     [](char c) { return (c | 0x20) >= 'a' && (c | 0x20) <= 'z'; });
}

}  // namespace sinew::jsonld
