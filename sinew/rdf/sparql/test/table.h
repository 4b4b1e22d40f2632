// Small data in Turtle, and results as short names, so that a test reads as a table.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/sparql/prepared.h"
#include "sinew/rdf/turtle/reader.h"

namespace sinew::rdf::sparql {

// Rows of terms: ":name" for http://e/name, "-" for unbound, N-Triples for the rest; sorted.
using Rows = std::vector<std::vector<std::string>>;

struct Table {
  explicit Table(std::string_view trig) {
    graph::Transaction transaction = store.begin();
    ReadOptions options;
    options.base = "http://e/";
    read_rdf(trig, Syntax::kTriG, options, store.terms(),
             [&](const graph::Quad& quad, std::size_t, std::size_t) { transaction.add(quad); });
    transaction.commit();
  }

  graph::Id id(std::string_view name) {
    return store.terms().iri("http://e/" + std::string(name.substr(1)));
  }
  std::string name(graph::Id id) const {
    if (!id) return "-";
    std::string text = store.terms().to_string(id);
    if (text.starts_with("<http://e/")) return ":" + text.substr(10, text.size() - 11);
    const std::size_t type = text.find("^^<http://www.w3.org/2001/XMLSchema#");
    if (type == std::string::npos) return text;
    // 1, 1.5, true; all else keeps its datatype's short name.
    const std::string lexical = text.substr(1, type - 2);
    const std::string datatype = text.substr(type + 36, text.size() - type - 37);
    if (datatype == "integer" || datatype == "decimal" || datatype == "boolean") return lexical;
    return "\"" + lexical + "\"^^" + datatype;
  }
  Rows rows(const Prepared& query, std::vector<graph::Id> parameters) {
    Rows result;
    query.select(store.view(), parameters, [&](std::span<const graph::Id> row) {
      auto& names = result.emplace_back();
      for (const graph::Id id : row) names.push_back(name(id));
      return true;
    });
    std::sort(result.begin(), result.end());
    return result;
  }

  graph::Store store;
};

}  // namespace sinew::rdf::sparql
