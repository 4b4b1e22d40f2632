// The one file that uses ICU: case mapping and the names of Unicode's blocks.
#include <unicode/ucasemap.h>
#include <unicode/uchar.h>
#include <unicode/uset.h>

#include <memory>

#include "sinew/rdf/sparql/values/strings.h"

namespace sinew::rdf::sparql::values {
namespace {

using MapFunction = int32_t(const UCaseMap*, char*, int32_t, const char*, int32_t, UErrorCode*);

// The root locale, so that the result is the same everywhere.
const UCaseMap* case_map() {
  static const UCaseMap* const map = [] {
    UErrorCode error = U_ZERO_ERROR;
    return ucasemap_open("", 0, &error);
  }();
  return map;
}

std::string mapped(std::string_view text, MapFunction* function) {
  const auto is_ascii = [](char c) { return (c & 0x80) == 0; };
  std::string result(text);
  bool plain = true;
  for (const char c : text) plain &= is_ascii(c);
  if (plain) {
    const bool up = function == ucasemap_utf8ToUpper;
    for (char& c : result) {
      if (up && c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
      if (!up && c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
  }
  const auto size = static_cast<int32_t>(text.size());
  UErrorCode error = U_ZERO_ERROR;
  const int32_t needed = function(case_map(), nullptr, 0, text.data(), size, &error);
  result.resize(static_cast<std::size_t>(needed));
  error = U_ZERO_ERROR;
  function(case_map(), result.data(), needed, text.data(), size, &error);
  return U_FAILURE(error) ? std::string(text) : result;
}

}  // namespace

std::string upper_case(std::string_view text) { return mapped(text, ucasemap_utf8ToUpper); }
std::string lower_case(std::string_view text) { return mapped(text, ucasemap_utf8ToLower); }

std::optional<CodeRange> unicode_block(std::string_view name) {
  const std::string wanted(name);
  const int32_t block = u_getPropertyValueEnum(UCHAR_BLOCK, wanted.c_str());
  if (block == UCHAR_INVALID_CODE) return std::nullopt;
  UErrorCode error = U_ZERO_ERROR;
  const std::unique_ptr<USet, decltype(&uset_close)> set(uset_openEmpty(), uset_close);
  uset_applyIntPropertyValue(set.get(), UCHAR_BLOCK, block, &error);
  if (U_FAILURE(error) || uset_getItemCount(set.get()) != 1) return std::nullopt;
  UChar32 first = 0;
  UChar32 last = 0;
  uset_getItem(set.get(), 0, &first, &last, nullptr, 0, &error);
  return CodeRange{static_cast<char32_t>(first), static_cast<char32_t>(last)};
}

}  // namespace sinew::rdf::sparql::values
