// The one place where this module makes its errors. Each carries the name that the standard gives
// it (JSON-LD 1.1 API, section 9.6) as Problem::code.
#pragma once

#include <string>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/rdf/json/value.h"

namespace sinew::jsonld {

namespace code {
inline constexpr std::string_view kCollidingKeywords = "colliding keywords";
inline constexpr std::string_view kCompactionToListOfLists = "compaction to list of lists";
inline constexpr std::string_view kConflictingIndexes = "conflicting indexes";
inline constexpr std::string_view kContextOverflow = "context overflow";
inline constexpr std::string_view kCyclicIriMapping = "cyclic IRI mapping";
inline constexpr std::string_view kInvalidBaseDirection = "invalid base direction";
inline constexpr std::string_view kInvalidBaseIri = "invalid base IRI";
inline constexpr std::string_view kInvalidContainerMapping = "invalid container mapping";
inline constexpr std::string_view kInvalidContextEntry = "invalid context entry";
inline constexpr std::string_view kInvalidContextNullification = "invalid context nullification";
inline constexpr std::string_view kInvalidDefaultLanguage = "invalid default language";
inline constexpr std::string_view kInvalidIdValue = "invalid @id value";
inline constexpr std::string_view kInvalidImportValue = "invalid @import value";
inline constexpr std::string_view kInvalidIncludedValue = "invalid @included value";
inline constexpr std::string_view kInvalidIndexValue = "invalid @index value";
inline constexpr std::string_view kInvalidIriMapping = "invalid IRI mapping";
inline constexpr std::string_view kInvalidJsonLiteral = "invalid JSON literal";
inline constexpr std::string_view kInvalidKeywordAlias = "invalid keyword alias";
inline constexpr std::string_view kInvalidLanguageMapValue = "invalid language map value";
inline constexpr std::string_view kInvalidLanguageMapping = "invalid language mapping";
inline constexpr std::string_view kInvalidLanguageTaggedString = "invalid language-tagged string";
inline constexpr std::string_view kInvalidLanguageTaggedValue = "invalid language-tagged value";
inline constexpr std::string_view kInvalidLocalContext = "invalid local context";
inline constexpr std::string_view kInvalidNestValue = "invalid @nest value";
inline constexpr std::string_view kInvalidPrefixValue = "invalid @prefix value";
inline constexpr std::string_view kInvalidPropagateValue = "invalid @propagate value";
inline constexpr std::string_view kInvalidProtectedValue = "invalid @protected value";
inline constexpr std::string_view kInvalidRemoteContext = "invalid remote context";
inline constexpr std::string_view kInvalidReverseProperty = "invalid reverse property";
inline constexpr std::string_view kInvalidReversePropertyMap = "invalid reverse property map";
inline constexpr std::string_view kInvalidReversePropertyValue = "invalid reverse property value";
inline constexpr std::string_view kInvalidReverseValue = "invalid @reverse value";
inline constexpr std::string_view kInvalidScopedContext = "invalid scoped context";
inline constexpr std::string_view kInvalidSetOrListObject = "invalid set or list object";
inline constexpr std::string_view kInvalidTermDefinition = "invalid term definition";
inline constexpr std::string_view kInvalidTypeMapping = "invalid type mapping";
inline constexpr std::string_view kInvalidTypeValue = "invalid type value";
inline constexpr std::string_view kInvalidTypedValue = "invalid typed value";
inline constexpr std::string_view kInvalidValueObject = "invalid value object";
inline constexpr std::string_view kInvalidValueObjectValue = "invalid value object value";
inline constexpr std::string_view kInvalidVersionValue = "invalid @version value";
inline constexpr std::string_view kInvalidVocabMapping = "invalid vocab mapping";
inline constexpr std::string_view kIriConfusedWithPrefix = "IRI confused with prefix";
inline constexpr std::string_view kKeywordRedefinition = "keyword redefinition";
inline constexpr std::string_view kLoadingDocumentFailed = "loading document failed";
inline constexpr std::string_view kLoadingRemoteContextFailed = "loading remote context failed";
inline constexpr std::string_view kProcessingModeConflict = "processing mode conflict";
inline constexpr std::string_view kProtectedTermRedefinition = "protected term redefinition";
}  // namespace code

// Where a document came from: the name to report its faults with, and the URL against which the
// relative references to contexts in it are resolved.
struct Source {
  std::string_view file;
  std::string_view url;
};

Place place_in(const Source& source, json::Position position);

[[noreturn]] void fail(std::string_view code, Place place, std::string iri, std::string what,
                       std::string remedy);

// The value in a few words, for messages: "x", 3, an object, ...
std::string describe(const json::Value& value);

}  // namespace sinew::jsonld
