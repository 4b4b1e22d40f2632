#include "sinew/rdf/sparql/test/table.h"

#include <algorithm>

#include "sinew/base/error.h"
#include "sinew/rdf/turtle/reader.h"

namespace sinew::rdf::sparql {
namespace {

constexpr std::string_view kPrefixes =
    "PREFIX : <http://e/> PREFIX xsd: <http://www.w3.org/2001/XMLSchema#> ";
constexpr std::string_view kXsd = "^^<http://www.w3.org/2001/XMLSchema#";

std::string with_prefixes(std::string_view text) {
  return std::string(kPrefixes) + std::string(text);
}

}  // namespace

Table::Table(std::string_view trig) {
  graph::Transaction transaction = store.begin();
  ReadOptions options;
  options.base = "http://e/";
  read_rdf(with_prefixes(trig), Syntax::kTriG, options, store.terms(),
           [&](const graph::Quad& quad, std::size_t, std::size_t) { transaction.add(quad); });
  transaction.commit();
}

graph::Id Table::id(std::string_view name) {
  return store.terms().iri("http://e/" + std::string(name.substr(1)));
}

std::string Table::name(graph::Id id) const {
  if (!id) return "-";
  if (store.terms().is_blank(id)) return "_";
  std::string text = store.terms().to_string(id);
  if (text.starts_with("<http://e/")) return ":" + text.substr(10, text.size() - 11);
  const std::size_t type = text.rfind(kXsd);
  if (type == std::string::npos) return text;
  const std::string lexical = text.substr(0, type);
  const std::string datatype =
      text.substr(type + kXsd.size(), text.size() - type - kXsd.size() - 1);
  if (datatype == "integer" || datatype == "decimal" || datatype == "boolean") {
    return lexical.substr(1, lexical.size() - 2);
  }
  return lexical + "^^xsd:" + datatype;
}

Answer Table::answer(std::string_view text, const QueryOptions& options) {
  return query(store.view(), store.terms(), with_prefixes(text), options);
}

Rows Table::ordered_rows(std::string_view text) {
  Rows result;
  for (const auto& row : answer(text).results.rows) {
    auto& names = result.emplace_back();
    for (const graph::Id id : row) names.push_back(name(id));
  }
  return result;
}

Rows Table::rows(std::string_view text, const QueryOptions& options) {
  Rows result;
  for (const auto& row : answer(text, options).results.rows) {
    auto& names = result.emplace_back();
    for (const graph::Id id : row) names.push_back(name(id));
  }
  std::sort(result.begin(), result.end());
  return result;
}

bool Table::ask(std::string_view text, const QueryOptions& options) {
  return answer(text, options).results.boolean.value();
}

Rows Table::triples(std::string_view text) {
  Rows result;
  for (const graph::Quad& quad : answer(text).triples) {
    result.push_back({name(quad.subject), name(quad.predicate), name(quad.object)});
  }
  std::sort(result.begin(), result.end());
  return result;
}

Rows Table::rows(const Prepared& query, const std::vector<graph::Id>& parameters) {
  Rows result;
  query.select(store.view(), parameters, [&](std::span<const graph::Id> row) {
    auto& names = result.emplace_back();
    for (const graph::Id id : row) names.push_back(name(id));
    return true;
  });
  std::sort(result.begin(), result.end());
  return result;
}

UpdateCounts Table::update(std::string_view text, const UpdateOptions& options) {
  graph::Transaction transaction = store.begin();
  const UpdateCounts counts =
      sparql::update(transaction, store.terms(), with_prefixes(text), options);
  transaction.commit();
  return counts;
}

Rows Table::quads() const {
  Rows result;
  const auto add = [&](const graph::Quad& quad) {
    result.push_back(
        {name(quad.subject), name(quad.predicate), name(quad.object), name(quad.graph)});
    return true;
  };
  store.view().match({}, {}, {}, graph::Dataset::kDefault, add);
  store.view().match_named({}, {}, {}, add);
  std::sort(result.begin(), result.end());
  return result;
}

std::string Table::refusal(std::string_view text, const QueryOptions& options) {
  try {
    answer(text, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

std::string Table::update_refusal(std::string_view text, const UpdateOptions& options) {
  try {
    update(text, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace sinew::rdf::sparql
