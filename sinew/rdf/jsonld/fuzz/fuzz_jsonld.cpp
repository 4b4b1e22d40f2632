// All algorithms on any document: an Error with a code is the only way to fail, and a model that
// was loaded is the same after it has been written and loaded again.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/store.h"
#include "sinew/rdf/isomorphism/isomorphism.h"
#include "sinew/rdf/jsonld/load.h"
#include "sinew/rdf/jsonld/processor.h"
#include "sinew/rdf/jsonld/write.h"

namespace {

using namespace sinew;
using graph::Quad;

constexpr std::string_view kContext = R"({"@context": {
  "@version": 1.1,
  "ex": "https://example.org/",
  "xsd": "http://www.w3.org/2001/XMLSchema#",
  "T": {"@id": "ex:T", "@context": {"p": {"@id": "ex:tp", "@type": "@id"}, "u": {"@id": "ex:u"}}},
  "U": {"@id": "ex:U", "@context": {"@propagate": true, "p": {"@id": "ex:up", "@container": "@list"}}},
  "p": {"@id": "ex:p", "@type": "xsd:double"},
  "q": {"@id": "ex:q", "@container": ["@index", "@set"]},
  "r": {"@reverse": "ex:r"},
  "g": {"@id": "ex:g", "@container": ["@graph", "@id"]},
  "l": {"@id": "ex:l", "@container": "@language"},
  "t": {"@id": "ex:t", "@container": "@type", "@context": "https://example.org/b.json"},
  "n": "@nest",
  "m": {"@id": "ex:m", "@nest": "n"},
  "j": {"@id": "ex:j", "@type": "@json"},
  "v": {"@id": "ex:v", "@type": "@vocab", "@context": {"@vocab": "ex:vocab-"}},
  "id": "@id",
  "type": "@type"
}})";

catalogue::Catalogue make_catalogue() {
  catalogue::Catalogue catalogue = catalogue::Catalogue::without_metamodels();
  catalogue.add("https://example.org/a.json", "a.json", std::string(kContext));
  catalogue.add("https://example.org/b.json", "b.json",
                R"({"@context": ["a.json", {"@protected": true, "w": "ex:w"}]})");
  catalogue.add("https://example.org/c.json", "c.json", R"({"@context": {"@import": "a.json"}})");
  return catalogue;
}

template <typename Process>
void run(Process&& process) {
  try {
    process();
  } catch (const Error& error) {
    if (error.problems().front().code.empty()) std::abort();
  }
}

// Numbers keep their value and not their text, so that the second time nothing may change any more.
void check_round_trip(const catalogue::Catalogue& catalogue, std::string_view text) {
  graph::Terms terms;
  Report report;
  jsonld::LoadOptions load_options;
  load_options.base = "https://example.org/dir/document";
  load_options.lenient = true;
  load_options.local_contexts = false;
  const auto load = [&](std::string_view model) {
    std::vector<Quad> quads;
    jsonld::Loader(catalogue, load_options)
        .load(
            model, "model", terms, [&](const Quad& quad) { quads.push_back(quad); }, nullptr,
            report);
    std::sort(quads.begin(), quads.end());
    quads.erase(std::unique(quads.begin(), quads.end()), quads.end());
    return quads;
  };
  std::vector<Quad> quads = load(text);
  for (Quad& quad : quads) {
    if (!terms.is_literal(quad.object)) continue;
    const auto number = terms.number(quad.object);
    if (number && terms.text(terms.datatype(quad.object)).ends_with("#double")) {
      quad.object = terms.real(*number);
    }
  }
  std::sort(quads.begin(), quads.end());
  quads.erase(std::unique(quads.begin(), quads.end()), quads.end());

  jsonld::Writer writer(catalogue,
                        {{"https://example.org/a.json"}, {{"rob", "https://example.org/dir/"}}});
  const std::string written = writer.write(quads, terms);
  const std::vector<Quad> again = load(written);
  const auto same = rdf::compare_quads(quads, again, terms, 100'000);
  if (same.likeness != rdf::Likeness::kDifferent) return;
  std::fprintf(stderr, "%s\n%s\n", same.difference.c_str(), written.c_str());
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const catalogue::Catalogue catalogue = make_catalogue();
  static const json::Document context = json::read(kContext, "context");
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  json::Document document;
  try {
    document = json::read(text, "fuzz.jsonld");
  } catch (const Error&) {
    return 0;
  }
  const std::string_view url = "https://example.org/dir/document";
  jsonld::Options options;
  options.ordered = true;
  run([&] { jsonld::Processor(catalogue, options).compact(document, url, context); });
  run([&] { jsonld::Processor(catalogue, options).flatten(document, url, context); });
  run([&] {
    graph::Terms terms;
    std::vector<Quad> quads;
    jsonld::Processor processor(catalogue, options);
    processor.to_rdf(document, url, terms, [&](const Quad& quad) { quads.push_back(quad); });
    std::sort(quads.begin(), quads.end());
    quads.erase(std::unique(quads.begin(), quads.end()), quads.end());
    processor.from_rdf(quads, terms);
  });
  run([&] { check_round_trip(catalogue, text); });
  return 0;
}
