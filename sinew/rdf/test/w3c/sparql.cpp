// The suite of SPARQL 1.1: query, update, syntax of both, and the result formats.
//
// Beyond what the suite asks, every answer is also written in the format of the expected one and
// read back, so that the writers are put to the test as well.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "manifest.h"
#include "report.h"
#include "sinew/base/error.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/isomorphism/isomorphism.h"
#include "sinew/rdf/results/compare.h"
#include "sinew/rdf/results/formats.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/rdf/turtle/writer.h"
#include "sparql_data.h"

namespace sinew::rdf::w3c {
namespace {

using graph::Id;
using graph::Quad;
namespace fs = std::filesystem;

// The suite means the unnamed graph where it says "default graph".
sparql::QueryOptions options_for(const fs::path& file) {
  sparql::QueryOptions options;
  options.name = file.filename().string();
  options.base = file_iri(file.string());
  options.dataset = graph::Dataset::kDefault;
  return options;
}

// The triples of a file, in the graph with this IRI, or in the unnamed one.
std::vector<Quad> read_graph(const fs::path& file, std::string_view graph_iri,
                             graph::Terms& terms) {
  std::vector<Quad> quads = read_data(file, terms);
  if (graph_iri.empty()) return quads;
  const Id graph = terms.iri(graph_iri);
  for (Quad& quad : quads) quad.graph = graph;
  return quads;
}

void load(graph::Store& store, const fs::path& file, std::string_view graph_iri) {
  const std::vector<Quad> quads = read_graph(file, graph_iri, store.terms());
  graph::Transaction transaction = store.begin();
  if (!graph_iri.empty()) transaction.create_graph(store.terms().iri(graph_iri));
  for (const Quad& quad : quads) transaction.add(quad);
  transaction.commit();
}

bool mentions(std::string text, std::string_view keyword) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text.find(keyword) != std::string::npos;
}

class SparqlSuite {
 public:
  explicit SparqlSuite(SuiteReport& report) : report_(report) {}

  void run(const fs::path& manifest_file) {
    const Manifest manifest(manifest_file);
    const std::string folder = manifest_file.parent_path().filename().string();
    for (const ManifestTest& test : manifest.tests()) {
      report_.test(folder + "/" + test.name, [&] { return run_test(manifest, test); });
    }
    for (const fs::path& file : manifest.included()) {
      if (fs::exists(file)) run(file);
    }
  }

 private:
  static std::string run_test(const Manifest& manifest, const ManifestTest& test) {
    if (test.kind == "QueryEvaluationTest" || test.kind == "CSVResultFormatTest") {
      return query_evaluation(manifest, test);
    }
    if (test.kind == "UpdateEvaluationTest") return update_evaluation(manifest, test);
    const bool positive = test.kind.starts_with("Positive");
    if (!positive && !test.kind.starts_with("Negative")) return "an unknown kind: " + test.kind;
    return syntax(manifest.file(test.action), positive,
                  test.kind.find("Update") != std::string::npos);
  }

  static std::string syntax(const fs::path& file, bool positive, bool update) {
    graph::Terms terms;
    const std::string text = read_file(file);
    try {
      if (update) {
        sparql::check_update(terms, text, options_for(file));
      } else {
        sparql::check_query(terms, text, options_for(file));
      }
    } catch (const Error& error) {
      if (positive) return error.what();
      const Problem& problem = error.problems().front();
      if (problem.place.line == 0 || problem.place.column == 0 || problem.remedy.empty()) {
        return std::string("an error without place or remedy: ") + error.what();
      }
      return {};
    }
    return positive ? "" : "accepted, but it is wrong";
  }

  static std::string query_evaluation(const Manifest& manifest, const ManifestTest& test) {
    graph::Store store;
    const fs::path file = manifest.file(manifest.one(test.action, "qt:query"));
    const std::string text = read_file(file);
    const std::vector<Id> data = manifest.all(test.action, "qt:data");
    const std::vector<Id> graphs = manifest.all(test.action, "qt:graphData");
    for (const Id part : data) load(store, manifest.file(part), {});
    for (const Id part : graphs) {
      load(store, manifest.file(part), manifest.store().terms().text(part));
    }
    if (data.empty() && graphs.empty() && mentions(text, "FROM")) {
      // The query names its data; all that it could name are at hand.
      for (const auto& entry : fs::directory_iterator(file.parent_path())) {
        if (entry.path().extension() != ".ttl" || entry.path().filename() == "manifest.ttl")
          continue;
        load(store, entry.path(), file_iri(entry.path().string()));
      }
    }
    const sparql::Answer answer =
        sparql::query(store.view(), store.terms(), text, options_for(file));
    const fs::path expected_file = manifest.file(test.result);
    Expected expected = read_expected(expected_file, store.terms());
    expected.ordered |= !expected.is_graph && mentions(text, "ORDER BY");
    return compare(answer, expected, result_format_of_file(expected_file.string()), store.terms());
  }

  static std::string compare(const sparql::Answer& answer, const Expected& expected,
                             std::optional<ResultFormat> format, graph::Terms& terms) {
    if (expected.is_graph) {
      return compare_quads(with_plain_literals(answer.triples, terms),
                           with_plain_literals(expected.graph, terms), terms)
          .difference;
    }
    const ResultSet right = with_plain_literals(expected.results, terms);
    // CSV does not tell terms apart: an answer is only comparable after it has been written as CSV.
    if (format != ResultFormat::kCsv) {
      const Comparison same = compare_results(with_plain_literals(answer.results, terms), right,
                                              expected.ordered, terms);
      if (!same) return same.difference;
    }
    if (!format) return {};
    const std::string written = write_results(answer.results, *format, terms);
    const ResultSet again = read_results(written, *format, "what we wrote", terms);
    const Comparison same =
        compare_results(with_plain_literals(again, terms), right, expected.ordered, terms);
    return same ? "" : "after writing and reading: " + same.difference;
  }

  // Visits file and graph IRI of each part of the data of an update test, before or after.
  template <typename Visit>
  static void dataset(const Manifest& manifest, Id description, Visit visit) {
    for (const Id part : manifest.all(description, "ut:data")) visit(manifest.file(part), "");
    for (const Id part : manifest.all(description, "ut:graphData")) {
      visit(manifest.file(manifest.one(part, "ut:graph")),
            manifest.text(part, "rdfs:label").value());
    }
  }

  static std::string update_evaluation(const Manifest& manifest, const ManifestTest& test) {
    graph::Store store;
    dataset(manifest, test.action,
            [&](const fs::path& file, const std::string& graph) { load(store, file, graph); });
    const fs::path request = manifest.file(manifest.one(test.action, "ut:request"));
    sparql::UpdateOptions options;
    static_cast<sparql::QueryOptions&>(options) = options_for(request);
    graph::Transaction transaction = store.begin();
    sparql::update(transaction, store.terms(), read_file(request), options);
    transaction.commit();

    std::vector<Quad> expected;
    dataset(manifest, test.result, [&](const fs::path& file, const std::string& graph) {
      const std::vector<Quad> part = read_graph(file, graph, store.terms());
      expected.insert(expected.end(), part.begin(), part.end());
    });
    return compare_quads(with_plain_literals(quads_of(store.view()), store.terms()),
                         with_plain_literals(expected, store.terms()), store.terms())
        .difference;
  }

  SuiteReport& report_;
};

}  // namespace
}  // namespace sinew::rdf::w3c

int main(int argc, char** argv) {
  using namespace sinew::rdf::w3c;
  return run(argc, argv, {{"sparql11", [](const auto& folder, SuiteReport& report) {
                             SparqlSuite(report).run(folder / "manifest-all.ttl");
                           }}});
}
