// What SHACL demands of queries, so that variables may have a value before the query begins (SHACL,
// sections 5.2.1 and 5.3.1).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sinew/rdf/sparql/syntax/ast.h"

namespace sinew::rdf::shacl {

// Why the query must be refused, or nothing. No MINUS, VALUES or SERVICE; no new value for one of
// the pre-bound variables; every sub-select returns all of `returned`; PATH only as a predicate.
std::optional<std::string> prebinding_fault(const sparql::syntax::Query& query,
                                            std::span<const std::string_view> prebound,
                                            std::span<const std::string_view> returned);

// The text with each ?PATH and $PATH replaced, except in strings, IRIs and comments.
std::string with_path(std::string_view query, std::string_view path);

}  // namespace sinew::rdf::shacl
