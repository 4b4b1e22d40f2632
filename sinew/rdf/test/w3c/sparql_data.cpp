#include "sparql_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "rdfxml.h"
#include "report.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/results/formats.h"
#include "sinew/rdf/turtle/reader.h"

namespace sinew::rdf::w3c {
namespace {

using graph::Id;
using graph::Quad;

constexpr std::string_view kVocabulary = "http://www.w3.org/2001/sw/DataAccess/tests/result-set#";

// A result set that is described as a graph.
class ResultGraph {
 public:
  ResultGraph(const std::vector<Quad>& quads, graph::Terms& terms) : quads_(quads), terms_(terms) {}

  bool has_results() const {
    const Id type = terms_.find_iri(std::string(kVocabulary) + "ResultSet");
    return type && std::ranges::any_of(quads_, [&](const Quad& q) { return q.object == type; });
  }

  Expected read() {
    Expected expected;
    const Id type = terms_.find_iri(std::string(kVocabulary) + "ResultSet");
    const Id self = std::ranges::find(quads_, type, &Quad::object)->subject;
    for (const Id boolean : all(self, "boolean")) {
      expected.results.boolean = terms_.text(boolean) == "true";
    }
    for (const Id name : all(self, "resultVariable")) {
      expected.results.columns.emplace_back(terms_.text(name));
    }
    std::vector<std::pair<std::int64_t, std::vector<Id>>> rows;
    for (const Id solution : all(self, "solution")) {
      auto& [index, row] = rows.emplace_back();
      row.resize(expected.results.columns.size());
      for (const Id number : all(solution, "index")) {
        index = terms_.integer_value(number).value();
        expected.ordered = true;
      }
      for (const Id binding : all(solution, "binding")) {
        const std::string_view name = terms_.text(all(binding, "variable").at(0));
        const auto column = std::ranges::find(expected.results.columns, name);
        row.at(static_cast<std::size_t>(column - expected.results.columns.begin())) =
            all(binding, "value").at(0);
      }
    }
    std::ranges::sort(rows, {}, [](const auto& entry) { return entry.first; });
    for (auto& [index, row] : rows) expected.results.rows.push_back(std::move(row));
    return expected;
  }

 private:
  std::vector<Id> all(Id subject, const char* property) const {
    const Id predicate = terms_.find_iri(std::string(kVocabulary) + property);
    std::vector<Id> objects;
    for (const Quad& quad : quads_) {
      if (quad.subject == subject && quad.predicate == predicate) objects.push_back(quad.object);
    }
    return objects;
  }

  const std::vector<Quad>& quads_;
  graph::Terms& terms_;
};

Id with_plain_literal(Id id, graph::Terms& terms) {
  if (!id || !terms.is_literal(id)) return id;
  if (const std::string_view language = terms.language(id); !language.empty()) {
    std::string tag(language);
    std::ranges::transform(tag, tag.begin(), [](unsigned char c) { return std::tolower(c); });
    return terms.literal(terms.text(id), {}, tag);
  }
  const auto number = terms.number(id);
  const std::string_view datatype = terms.text(terms.datatype(id));
  const bool fractional = datatype.ends_with("#decimal") || datatype.ends_with("#double") ||
                          datatype.ends_with("#float");
  if (!number || !fractional) return id;
  return terms.literal(fmt::format("{}", *number), terms.datatype(id));
}

}  // namespace

std::vector<Quad> read_data(const std::filesystem::path& file, graph::Terms& terms) {
  const std::string text = read_file(file), iri = file_iri(file.string());
  if (file.extension() == ".rdf") return read_rdf_xml(text, iri, terms);
  std::vector<Quad> quads;
  read_rdf(text, syntax_of_file(file.string()).value(), {file.string(), iri, {}}, terms,
           [&](const Quad& quad, std::size_t, std::size_t) { quads.push_back(quad); });
  return quads;
}

Expected read_expected(const std::filesystem::path& file, graph::Terms& terms) {
  Expected expected;
  if (const auto format = result_format_of_file(file.string())) {
    expected.results = read_results(read_file(file), *format, file.string(), terms);
    return expected;
  }
  expected.graph = read_data(file, terms);
  ResultGraph description(expected.graph, terms);
  if (description.has_results()) return description.read();
  expected.is_graph = true;
  return expected;
}

ResultSet with_plain_literals(const ResultSet& results, graph::Terms& terms) {
  ResultSet plain = results;
  for (auto& row : plain.rows) {
    for (Id& id : row) id = with_plain_literal(id, terms);
  }
  return plain;
}

std::vector<Quad> with_plain_literals(const std::vector<Quad>& quads, graph::Terms& terms) {
  std::vector<Quad> plain = quads;
  for (Quad& quad : plain) quad.object = with_plain_literal(quad.object, terms);
  return plain;
}

}  // namespace sinew::rdf::w3c
