// The suites of JSON-LD 1.1: expansion, compaction, and the way to RDF and back.
#include <fmt/format.h>

#include <algorithm>

#include "report.h"
#include "sinew/base/error.h"
#include "sinew/rdf/isomorphism/isomorphism.h"
#include "sinew/rdf/json/writer.h"
#include "sinew/rdf/jsonld/load.h"
#include "sinew/rdf/jsonld/processor.h"
#include "sinew/rdf/jsonld/write.h"
#include "sinew/rdf/turtle/reader.h"

namespace sinew::rdf::w3c {
namespace {

namespace fs = std::filesystem;
using graph::Quad;
using jsonld::Processor;

constexpr std::string_view kTestBase = "https://w3c.github.io/json-ld-api/tests/";

// Equal as JSON-LD: arrays are sets, except under "@list"; what is under "@json" is not looked
// into.
bool same_json_ld(const json::Value& a, const json::Value& b, bool in_list = false) {
  if (a.kind() != b.kind()) return false;
  if (a.is_array()) {
    if (a.items().size() != b.items().size()) return false;
    if (in_list) {
      return std::equal(a.items().begin(), a.items().end(), b.items().begin(),
                        [](const auto& x, const auto& y) { return same_json_ld(x, y, true); });
    }
    std::vector<bool> used(b.items().size());
    return std::all_of(a.items().begin(), a.items().end(), [&](const json::Value& item) {
      for (std::size_t i = 0; i < b.items().size(); ++i) {
        if (used[i] || !same_json_ld(item, b.items()[i])) continue;
        used[i] = true;
        return true;
      }
      return false;
    });
  }
  if (!a.is_object()) return json::equal(a, b);
  if (a.members().size() != b.members().size()) return false;
  return std::all_of(a.members().begin(), a.members().end(), [&](const json::Member& member) {
    const json::Value* other = b.find(member.name());
    return other != nullptr && same_json_ld(member.value, *other, member.name() == "@list");
  });
}

struct Test {
  const json::Value& entry;
  const fs::path& folder;

  std::string_view text(std::string_view key) const {
    const json::Value* value = entry.find(key);
    return value == nullptr ? std::string_view{} : value->text();
  }
  const json::Value* option(std::string_view key) const {
    const json::Value* options = entry.find("option");
    return options == nullptr ? nullptr : options->find(key);
  }
  std::string_view option_text(std::string_view key) const {
    const json::Value* value = option(key);
    return value == nullptr ? std::string_view{} : value->text();
  }
  bool is_a(std::string_view type) const {
    const auto types = entry.find("@type")->items();
    return std::any_of(types.begin(), types.end(),
                       [&](const json::Value& value) { return value.is_string(type); });
  }
  std::string input_url() const { return std::string(kTestBase) + std::string(text("input")); }
  json::Document read_json(std::string_view name) const {
    return json::read(read_file(folder / name), std::string(name));
  }
};

jsonld::Options options_of(const Test& test, const json::Document& expand_context) {
  jsonld::Options options;
  const auto flag = [&](std::string_view key, bool& value) {
    if (const json::Value* found = test.option(key)) value = found->is_true();
  };
  options.base = test.option_text("base");
  options.expand_context = expand_context.root;
  flag("compactArrays", options.compact_arrays);
  flag("compactToRelative", options.compact_to_relative);
  flag("useNativeTypes", options.use_native_types);
  flag("useRdfType", options.use_rdf_type);
  flag("produceGeneralizedRdf", options.produce_generalized_rdf);
  if (test.option_text("processingMode") == "json-ld-1.0") {
    options.processing_mode = jsonld::ProcessingMode::kJsonLd10;
  }
  if (test.option_text("rdfDirection") == "i18n-datatype") {
    options.rdf_direction = jsonld::RdfDirection::kI18nDatatype;
  }
  if (test.option_text("rdfDirection") == "compound-literal") {
    options.rdf_direction = jsonld::RdfDirection::kCompoundLiteral;
  }
  return options;
}

std::string compare_json(const json::Value& actual, const Test& test) {
  const json::Document expected = test.read_json(test.text("expect"));
  if (same_json_ld(actual, expected.root)) return {};
  return fmt::format("expected\n{}but got\n{}", json::to_pretty_text(expected.root),
                     json::to_pretty_text(actual));
}

std::string run_expand(const Test& test, Processor& processor, const json::Document& input) {
  const json::Value result = processor.expand(input, test.input_url());
  return test.text("expect").empty() ? "" : compare_json(result, test);
}

std::string run_compact(const Test& test, Processor& processor, const json::Document& input) {
  const json::Document context = test.read_json(test.text("context"));
  const json::Value result = processor.compact(input, test.input_url(), context);
  return test.text("expect").empty() ? "" : compare_json(result, test);
}

// Generalized RDF has blank nodes as predicates, which N-Quads does not. Reads "s _:p o ." by way
// of an IRI that stands for the blank node.
std::vector<Quad> read_expected_quads(const std::string& name, std::string text, bool generalized,
                                      graph::Terms& terms) {
  constexpr std::string_view kStandIn = "generalized:";
  for (std::size_t at = text.find("> _:"); generalized && at != std::string::npos;
       at = text.find("> _:", at + 1)) {
    const std::size_t end = text.find(' ', at + 2);
    if (text[end + 1] == '.') continue;  // an object
    text.replace(at + 2, end - at - 2,
                 fmt::format("<{}{}>", kStandIn, text.substr(at + 4, end - at - 4)));
  }
  std::vector<Quad> quads;
  read_rdf(text, Syntax::kNQuads, {name, "", {}}, terms, [&](Quad quad, std::size_t, std::size_t) {
    const std::string_view predicate = terms.text(quad.predicate);
    if (predicate.starts_with(kStandIn)) quad.predicate = terms.blank(predicate);
    quads.push_back(quad);
  });
  return quads;
}

std::vector<Quad> to_quads(Processor& processor, const json::Document& document,
                           const std::string& url, graph::Terms& terms) {
  std::vector<Quad> quads;
  processor.to_rdf(document, url, terms, [&](const Quad& quad) { quads.push_back(quad); });
  std::sort(quads.begin(), quads.end());
  quads.erase(std::unique(quads.begin(), quads.end()), quads.end());
  return quads;
}

// Not asked for by the suite: what is turned back into JSON-LD must say the same.
std::string round_trip(Processor& processor, const std::vector<Quad>& quads, graph::Terms& terms) {
  json::Document again;
  again.root = processor.from_rdf(quads, terms);
  const Comparison same = compare_quads(quads, to_quads(processor, again, "", terms), terms);
  if (same) return {};
  return fmt::format("changed on the way back: {}\n{}", same.difference,
                     json::to_pretty_text(again.root));
}

// Flattening must not change what a document says, and leaves each node once in a graph.
std::string flattened(const Test& test, Processor& processor, const json::Document& input,
                      const jsonld::Options& options, const std::vector<Quad>& quads,
                      graph::Terms& terms) {
  const json::Value flat = processor.flatten(input, test.input_url(), {});
  for (const json::Value& node : flat.items()) {
    for (const json::Member& member : node.members()) {
      if (member.name() == "@graph" || member.name() == "@type") continue;
      for (const json::Value& value : member.value.items()) {
        const bool reference = value.members().size() == 1 && value.find("@id") != nullptr;
        if (reference || value.find("@value") || value.find("@list")) continue;
        return "not flat: " + json::to_text(value);
      }
    }
  }
  std::vector<Quad> again;
  const jsonld::QuadSink sink = [&](const Quad& quad) { again.push_back(quad); };
  jsonld::ToRdf({.terms = terms, .options = options, .source = {}}, sink).document(flat);
  const Comparison same = compare_quads(quads, again, terms);
  return same ? "" : fmt::format("changed by flattening: {}", same.difference);
}

// The same for what a person would read: written and loaded as a model, up to the notation of
// numbers.
std::string model_round_trip(std::vector<Quad> quads, graph::Terms& terms) {
  for (Quad& quad : quads) {
    if (!terms.is_literal(quad.object)) continue;
    const std::string_view datatype = terms.text(terms.datatype(quad.object));
    const auto number = terms.number(quad.object);
    if (datatype.ends_with("#double") && number) quad.object = terms.real(*number);
  }
  static const catalogue::Catalogue kNoContexts = catalogue::Catalogue::without_metamodels();
  jsonld::Writer writer(
      kNoContexts,
      {{}, {{"xsd", "http://www.w3.org/2001/XMLSchema#"}, {"com", "http://example.com/"}}});
  const std::string text = writer.write(quads, terms);
  std::vector<Quad> again;
  Report report;
  jsonld::Loader(kNoContexts)
      .load(
          text, "what was written", terms, [&](const Quad& quad) { again.push_back(quad); },
          nullptr, report);
  std::string why;
  if (!report.problems().empty()) why = to_string(report.problems().front());
  if (const Comparison same = compare_quads(quads, again, terms); !same) why += same.difference;
  if (why.empty() && writer.write(again, terms) != text) why = "written differently again";
  return why.empty() ? why : fmt::format("as a model: {}\n{}", why, text);
}

std::string run_to_rdf(const Test& test, Processor& processor, const json::Document& input) {
  graph::Terms terms;
  const std::vector<Quad> quads = to_quads(processor, input, test.input_url(), terms);
  const std::string name(test.text("expect"));
  if (name.empty()) return {};
  const json::Value* generalized = test.option("produceGeneralizedRdf");
  const auto expected = read_expected_quads(
      name, read_file(test.folder / name), generalized != nullptr && generalized->is_true(), terms);
  if (const Comparison same = compare_quads(quads, expected, terms); !same) return same.difference;
  std::string why = flattened(test, processor, input, options_of(test, {}), quads, terms);
  if (why.empty()) why = round_trip(processor, quads, terms);
  if (!why.empty() || (generalized != nullptr && generalized->is_true())) return why;
  return model_round_trip(quads, terms);
}

using Run = std::string (*)(const Test&, Processor&, const json::Document&);

// An error must be the one that the test names, and say where it is and what would be right.
std::string check_error(const Test& test, const Problem& problem) {
  const std::string_view expected = test.text("expectErrorCode");
  if (problem.code != expected) {
    return fmt::format("expected the error \"{}\" but got \"{}\": {}", expected, problem.code,
                       to_string(problem));
  }
  if (problem.place.line == 0 || problem.remedy.empty()) {
    return "an error without place or remedy: " + to_string(problem);
  }
  return {};
}

void run_suite(const fs::path& folder, const std::string& manifest_name, Run run,
               SuiteReport& report) {
  catalogue::Catalogue catalogue = catalogue::Catalogue::without_metamodels();
  for (const auto& file : fs::recursive_directory_iterator(folder)) {
    if (file.path().extension() != ".jsonld") continue;
    const std::string name = file.path().lexically_relative(folder).generic_string();
    catalogue.add(std::string(kTestBase) + name, name, read_file(file.path()));
  }
  const json::Document manifest = json::read(read_file(folder / manifest_name), manifest_name);
  for (const json::Value& entry : manifest.root.find("sequence")->items()) {
    const Test test{entry, folder};
    report.test(std::string(test.text("@id").substr(1)), [&]() -> std::string {
      const bool negative = test.is_a("jld:NegativeEvaluationTest");
      try {
        json::Document expand_context;
        if (const auto name = test.option_text("expandContext"); !name.empty()) {
          expand_context = test.read_json(name);
        }
        Processor processor(catalogue, options_of(test, expand_context));
        const std::string why = run(test, processor, test.read_json(test.text("input")));
        return negative ? "accepted, but it is wrong" : why;
      } catch (const Error& error) {
        if (!negative) return error.what();
        return check_error(test, error.problems().front());
      }
    });
  }
}

}  // namespace
}  // namespace sinew::rdf::w3c

int main(int argc, char** argv) {
  using namespace sinew::rdf::w3c;
  const auto suite = [](const char* manifest, Run run) {
    return [=](const fs::path& folder, SuiteReport& report) {
      run_suite(folder, manifest, run, report);
    };
  };
  return run(argc, argv,
             {{"jsonld-expand", suite("expand-manifest.jsonld", run_expand)},
              {"jsonld-toRdf", suite("toRdf-manifest.jsonld", run_to_rdf)},
              {"jsonld-compact", suite("compact-manifest.jsonld", run_compact)}});
}
