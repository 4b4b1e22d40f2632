// Models as a person would write them.
#include "sinew/rdf/jsonld/write.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "sinew/rdf/isomorphism/isomorphism.h"
#include "sinew/rdf/jsonld/load.h"

namespace sinew::jsonld {
namespace {

using graph::Id;
using graph::Quad;
namespace fs = std::filesystem;

constexpr std::string_view kContext = R"({"@context": {
  "@version": 1.1,
  "xsd": "http://www.w3.org/2001/XMLSchema#",
  "ex": "https://example.org/",
  "name": {"@id": "ex:name", "@type": "xsd:string"},
  "mass": {"@id": "ex:mass", "@type": "xsd:double"},
  "offset": {"@id": "ex:offset", "@container": "@list"},
  "price": {"@id": "ex:price", "@type": "xsd:decimal"},
  "count": "ex:count",
  "parts": {"@id": "ex:parts", "@container": "@set", "@type": "@id"}
}})";

class Writing : public testing::Test {
 protected:
  Writing() { catalogue_.add("https://example.org/c.json", "c.json", std::string(kContext)); }

  Id iri(const char* name) { return terms_.iri(std::string("https://example.org/") + name); }
  void add(const char* subject, const char* predicate, Id object) {
    quads_.push_back({iri(subject), iri(predicate), object});
  }
  std::string write(bool sorted = false) {
    WriteOptions options;
    options.contexts = {"https://example.org/c.json"};
    options.prefixes = {{"r", "https://robot.example/"}};
    options.sorted = sorted;
    return Writer(catalogue_, options).write(quads_, terms_);
  }
  std::vector<Quad> read(const std::string& text) {
    std::vector<Quad> result;
    Report report;
    Loader(catalogue_)
        .load(
            text, "written", terms_, [&](const Quad& q) { result.push_back(q); }, nullptr, report);
    EXPECT_TRUE(report.problems().empty());
    return result;
  }
  catalogue::Catalogue catalogue_ = catalogue::Catalogue::without_metamodels();
  graph::Terms terms_;
  std::vector<Quad> quads_;
};

TEST_F(Writing, UsesTermsAndPlainValues) {
  add("n", "count", terms_.integer(3));
  add("n", "name", terms_.literal("a \"name\""));
  add("n", "mass", terms_.real(2));
  add("n", "price", terms_.literal("2.50", "http://www.w3.org/2001/XMLSchema#decimal"));
  add("n", "parts", iri("a"));
  add("n", "flag", terms_.boolean(true));
  add("n", "real", terms_.real(2));
  EXPECT_EQ(write(), R"({
  "@context": [
    "https://example.org/c.json",
    { "r": "https://robot.example/" }
  ],
  "@id": "ex:n",
  "count": 3,
  "name": "a \"name\"",
  "mass": 2.0,
  "price": 2.50,
  "parts": ["ex:a"],
  "ex:flag": true,
  "ex:real": 2.0
}
)");
  EXPECT_EQ(rdf::compare_quads(quads_, read(write()), terms_).difference, "");
}

// ex://twice, short for it, is no compact IRI but an IRI with an authority.
TEST_F(Writing, DoesNotAbbreviateWhatWouldReadBackAsAnotherIri) {
  add("arm", "parts", iri("//twice"));
  const std::string text = write();
  EXPECT_NE(text.find("\"https://example.org///twice\""), std::string::npos) << text;
  EXPECT_EQ(read(text), quads_);
}

// A type is written by its label, which a node written inside another one would not have.
TEST_F(Writing, KeepsTheLabelOfWhatIsAlsoAType) {
  const Id kind = terms_.fresh_blank();
  const Id type = terms_.iri("http://www.w3.org/1999/02/22-rdf-syntax-ns#type");
  add("arm", "parts", kind);
  quads_.push_back({iri("arm"), type, kind});
  quads_.push_back({kind, type, iri("Kind")});
  const std::string text = write();
  EXPECT_TRUE(rdf::compare_quads(quads_, read(text), terms_, 1000)) << text;
}

TEST_F(Writing, KeepsEveryDoubleExactly) {
  for (const double value : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0, 1e22, 1e21,
                             123456789.0, 0.30000000000000004, std::nextafter(1.0, 2.0)}) {
    quads_.clear();
    add("n", "mass", terms_.real(value));
    add("n", "count", terms_.real(value));
    const std::vector<Quad> again = read(write());
    ASSERT_EQ(again.size(), 2u) << write();
    EXPECT_EQ(again[0].object, terms_.real(value)) << write();
    EXPECT_EQ(again[1].object, terms_.real(value)) << write();
  }
}

TEST_F(Writing, KeepsNumbersThatJsonCannotWrite) {
  add("n", "mass", terms_.real(std::numeric_limits<double>::infinity()));
  add("n", "count", terms_.literal("+5", "http://www.w3.org/2001/XMLSchema#integer"));
  add("n", "price", terms_.literal(".5", "http://www.w3.org/2001/XMLSchema#decimal"));
  EXPECT_EQ(rdf::compare_quads(quads_, read(write()), terms_).difference, "") << write();
}

TEST_F(Writing, SortsWhenAskedTo) {
  add("n", "price", terms_.integer(1));
  add("m", "mass", terms_.real(1));
  add("m", "count", terms_.integer(1));
  const std::string text = write(true);
  EXPECT_LT(text.find("ex:m"), text.find("ex:n"));
  EXPECT_LT(text.find("count"), text.find("mass"));
  std::reverse(quads_.begin(), quads_.end());
  EXPECT_EQ(write(true), text);
}

TEST_F(Writing, FillsLinesWithLongListsOfNumbers) {
  std::string text = R"({"@context": "https://example.org/c.json", "@id": "ex:n", "offset": [)";
  for (int i = 0; i < 40; ++i) text += std::to_string(i) + ".125" + (i < 39 ? "," : "]}");
  quads_ = read(text);
  const std::string again = write();
  EXPECT_NE(again.find("\"offset\": [\n    0.125, 1.125, 2.125"), std::string::npos) << again;
  for (std::size_t start = 0, end; (end = again.find('\n', start)) != std::string::npos;
       start = end + 1) {
    EXPECT_LE(end - start, 100u);
  }
  EXPECT_EQ(rdf::compare_quads(quads_, read(again), terms_).difference, "");
}

TEST_F(Writing, WritesTheGraphsOfAStore) {
  graph::Store store;
  const auto id = [&](const char* name) {
    return store.terms().iri(std::string("https://example.org/") + name);
  };
  store.add({id("a"), id("count"), store.terms().integer(1), id("g")});
  store.add({id("b"), id("count"), store.terms().integer(2)});
  Writer writer(catalogue_, {{"https://example.org/c.json"}, {}});
  EXPECT_EQ(writer.write_graph(store.view(), id("g")), R"({
  "@context": "https://example.org/c.json",
  "@id": "ex:g",
  "@graph": [
    { "@id": "ex:a", "count": 1 }
  ]
}
)");
  const std::string all = writer.write_all(store.view());
  EXPECT_NE(all.find("ex:a"), std::string::npos);
  EXPECT_NE(all.find("ex:b"), std::string::npos);
}

TEST(WritingModels, Gen3ComesBackTheSameWithOurContexts) {
  const fs::path folder = fs::path(SINEW_SHARED_DIR) / "models/kinova/gen3/7dof";
  if (!fs::exists(folder)) GTEST_SKIP() << "no published models at " << folder;
  const catalogue::Catalogue catalogue;
  const std::string base(catalogue::kPublishedMetamodels);
  WriteOptions options;
  for (const char* name :
       {"geometry/structural-entities.json", "kinematic-chain/structural-entities.json",
        "newtonian-rigid-body-dynamics/structural-entities.json",
        "newtonian-rigid-body-dynamics/coordinates.json", "geometry/spatial-relations.json",
        "geometry/coordinates.json", "qudt.json"}) {
    options.contexts.push_back(base + name);
  }
  options.prefixes = {{"rob", "https://comp-rob2b.github.io/robots/kinova/gen3/7dof/"}};
  graph::Terms terms;
  std::vector<Quad> quads, again;
  Report report;
  Loader loader(catalogue);
  for (const auto& file : fs::directory_iterator(folder)) {
    std::ifstream stream(file.path(), std::ios::binary);
    loader.load(
        std::string(std::istreambuf_iterator<char>(stream), {}), file.path().string(), terms,
        [&](const Quad& quad) { quads.push_back(quad); }, nullptr, report);
  }
  std::sort(quads.begin(), quads.end());
  quads.erase(std::unique(quads.begin(), quads.end()), quads.end());
  Writer writer(catalogue, options);
  const std::string text = writer.write(quads, terms);
  loader.load(
      text, "written", terms, [&](const Quad& quad) { again.push_back(quad); }, nullptr, report);
  for (const Problem& problem : report.problems()) ADD_FAILURE() << to_string(problem);
  EXPECT_EQ(rdf::compare_quads(quads, again, terms).difference, "");
  EXPECT_EQ(text.find("https://comp-rob2b.github.io/robots/"),
            text.rfind("https://comp-rob2b.github.io/robots/"));
  EXPECT_EQ(text, writer.write(quads, terms));
}

}  // namespace
}  // namespace sinew::jsonld
