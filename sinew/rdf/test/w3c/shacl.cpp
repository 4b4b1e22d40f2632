// The suites of SHACL: data and shapes in, the expected validation report out.
//
// Reports are compared result by result: focus node, path, value, component, severity, shape, and
// the constraint and the messages where the expected result names them.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "manifest.h"
#include "report.h"
#include "sinew/base/error.h"
#include "sinew/rdf/shacl/shapes.h"
#include "sinew/rdf/shacl/validation.h"
#include "sinew/rdf/turtle/reader.h"

namespace sinew::rdf::w3c {
namespace {

using graph::Id;
using graph::Quad;
namespace fs = std::filesystem;

// The files of one test in one store, each read once, so that a blank node is the same wherever its
// file is used.
struct TestData {
  graph::Store store;
  std::map<fs::path, std::vector<Quad>> files;

  const std::vector<Quad>& file(const fs::path& path) {
    const auto [known, is_new] = files.try_emplace(path);
    if (is_new) {
      const std::string iri = "file://" + path.string();
      read_rdf(read_file(path), Syntax::kTurtle, {path.string(), iri, {}}, store.terms(),
               [&](const Quad& quad, std::size_t, std::size_t) { known->second.push_back(quad); });
    }
    return known->second;
  }
  void load(const fs::path& path, Id into) {
    const std::vector<Quad>& quads = file(path);
    graph::Transaction transaction = store.begin();
    for (const Quad& quad : quads) {
      transaction.add({quad.subject, quad.predicate, quad.object, into});
    }
    transaction.commit();
  }
};

// A path in the graph as text, in the form of shacl::to_sparql.
std::string path_text(const shacl::GraphReader& in, const shacl::Vocabulary& v, Id node) {
  const auto several = [&](Id list, char separator) {
    std::string text = "(";
    for (; list && list != v.rdf_nil; list = in.object(list, v.rdf_rest)) {
      if (text.size() > 1) text += separator;
      text += path_text(in, v, in.object(list, v.rdf_first));
    }
    return text + ")";
  };
  const auto inner = [&](Id property) { return path_text(in, v, in.object(node, property)); };
  if (in.object(node, v.rdf_first)) return several(node, '/');
  if (const Id list = in.object(node, v.alternative_path)) return several(list, '|');
  if (in.object(node, v.inverse_path)) return fmt::format("(^{})", inner(v.inverse_path));
  if (in.object(node, v.zero_or_more_path)) return fmt::format("({}*)", inner(v.zero_or_more_path));
  if (in.object(node, v.one_or_more_path)) return fmt::format("({}+)", inner(v.one_or_more_path));
  if (in.object(node, v.zero_or_one_path)) return fmt::format("({}?)", inner(v.zero_or_one_path));
  return in.terms().to_string(node);
}

std::string line(const graph::Terms& terms, Id focus, const std::string& path, Id value, Id shape,
                 Id component, Id severity) {
  const auto text = [&](Id id) { return id ? terms.to_string(id) : std::string("-"); };
  return fmt::format("{} | {} | {} | {} | {} | {}", text(focus), path, text(value), text(shape),
                     text(component), text(severity));
}

using Lines = std::multiset<std::string>;

std::string difference(const Lines& expected, const Lines& found) {
  Lines missing, extra;
  std::set_difference(expected.begin(), expected.end(), found.begin(), found.end(),
                      std::inserter(missing, missing.end()));
  std::set_difference(found.begin(), found.end(), expected.begin(), expected.end(),
                      std::inserter(extra, extra.end()));
  if (missing.empty() && extra.empty()) return {};
  std::string text;
  for (const std::string& one : missing) text += "\n  missing: " + one;
  for (const std::string& one : extra) text += "\n  not expected: " + one;
  return text;
}

std::string run_test(const fs::path& manifest_file, const Manifest& manifest,
                     const ManifestTest& test) {
  TestData data;
  graph::Terms& terms = data.store.terms();
  const fs::path data_file = manifest.file(manifest.one(test.action, "sht:dataGraph"));
  const fs::path shapes_file = manifest.file(manifest.one(test.action, "sht:shapesGraph"));
  const Id shapes_graph = terms.iri("file://" + shapes_file.string());
  const Id expected_graph = terms.iri("urn:the-expected-report");
  data.load(data_file, {});
  data.load(shapes_file, shapes_graph);
  data.load(manifest_file, expected_graph);

  const std::string failure = "http://www.w3.org/ns/shacl-test#Failure";
  const bool must_fail = manifest.store().terms().text(test.result) == failure;
  shacl::ValidationReport report;
  const shacl::Vocabulary v(terms);
  try {
    const shacl::Shapes shapes =
        shacl::parse_shapes(data.store, shacl::GraphReader(data.store.view(), shapes_graph));
    report =
        shacl::validate(shapes, shacl::GraphReader(data.store.view(), graph::Dataset::kDefault));
  } catch (const Error& error) {
    return must_fail ? "" : fmt::format("failed: {}", error.what());
  }
  if (must_fail) return "did not fail";

  const shacl::GraphReader expected(data.store.view(), expected_graph);
  const Id entry = terms.iri(std::string(manifest.store().terms().text(test.node)));
  const Id expected_report = expected.object(
      entry, terms.iri("http://www.w3.org/2001/sw/DataAccess/tests/test-manifest#result"));
  const bool conforms = terms.text(expected.object(expected_report, v.conforms)) == "true";
  if (conforms != report.conforms()) return fmt::format("conforms: {}", report.conforms());

  Lines expected_lines, found_lines, expected_messages, found_messages;
  Lines expected_constraints, found_constraints;
  for (const Id result : expected.objects(expected_report, v.result)) {
    const Id path = expected.object(result, v.result_path);
    expected_lines.insert(line(
        terms, expected.object(result, v.focus_node), path ? path_text(expected, v, path) : "-",
        expected.object(result, v.value), expected.object(result, v.source_shape),
        expected.object(result, v.source_constraint_component),
        expected.object(result, v.result_severity)));
    for (const Id message : expected.objects(result, v.result_message)) {
      expected_messages.insert(terms.to_string(message));
    }
    for (const Id constraint : expected.objects(result, v.source_constraint)) {
      expected_constraints.insert(terms.to_string(constraint));
    }
  }
  for (const shacl::Result& result : report.results) {
    found_lines.insert(line(terms, result.focus_node,
                            result.path ? shacl::to_sparql(*result.path, terms) : "-", result.value,
                            result.source_shape, result.component_iri, result.severity));
    for (const shacl::Message& message : result.messages) {
      found_messages.insert(terms.to_string(terms.literal(message.text, {}, message.language)));
    }
    if (result.source_constraint) {
      found_constraints.insert(terms.to_string(result.source_constraint));
    }
  }
  std::string wrong = difference(expected_lines, found_lines);
  if (!expected_messages.empty()) wrong += difference(expected_messages, found_messages);
  if (!expected_constraints.empty()) wrong += difference(expected_constraints, found_constraints);
  return wrong;
}

void run_manifest(const fs::path& file, SuiteReport& report) {
  const Manifest manifest(file);
  for (const fs::path& included : manifest.included()) run_manifest(included, report);
  for (const ManifestTest& test : manifest.tests()) {
    const std::string name =
        fmt::format("{}/{}", file.parent_path().filename().string(), test.name);
    report.test(name, [&] { return run_test(file, manifest, test); });
  }
}

void run_suite(const fs::path& folder, SuiteReport& report) {
  run_manifest(folder / "manifest.ttl", report);
}

}  // namespace
}  // namespace sinew::rdf::w3c

int main(int argc, char** argv) {
  using namespace sinew::rdf::w3c;
  return run(argc, argv, {{"shacl-core", run_suite}, {"shacl-sparql", run_suite}});
}
