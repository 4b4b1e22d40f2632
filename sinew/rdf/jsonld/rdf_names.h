// IRIs of RDF that only the mapping between JSON-LD and RDF uses (the others:
// graph/standard_iris.h).
#pragma once

#include <string_view>

namespace sinew::jsonld::rdf_name {

inline constexpr std::string_view kList = "http://www.w3.org/1999/02/22-rdf-syntax-ns#List";
inline constexpr std::string_view kJson = "http://www.w3.org/1999/02/22-rdf-syntax-ns#JSON";
inline constexpr std::string_view kValue = "http://www.w3.org/1999/02/22-rdf-syntax-ns#value";
inline constexpr std::string_view kLanguage = "http://www.w3.org/1999/02/22-rdf-syntax-ns#language";
inline constexpr std::string_view kDirection =
    "http://www.w3.org/1999/02/22-rdf-syntax-ns#direction";
inline constexpr std::string_view kI18n = "https://www.w3.org/ns/i18n#";

}  // namespace sinew::jsonld::rdf_name
