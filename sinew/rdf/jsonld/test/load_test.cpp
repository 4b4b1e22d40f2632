// Models: nothing is dropped in silence, and every fault has a place and a remedy.
#include "sinew/rdf/jsonld/load.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sinew/graph/store.h"

namespace sinew::jsonld {
namespace {

constexpr std::string_view kContext = R"({
  "@context": {
    "@version": 1.1,
    "xsd": "http://www.w3.org/2001/XMLSchema#",
    "ex": "https://example.org/",
    "Joint": "ex:Joint",
    "Mass": {
      "@id": "ex:Mass",
      "@context": { "kilograms": { "@id": "ex:kilograms", "@type": "xsd:double" } }
    },
    "axis": { "@id": "ex:axis", "@type": "@vocab" },
    "parent": { "@id": "ex:parent", "@type": "@id" },
    "limits": { "@id": "ex:limits", "@container": "@list" },
    "price": { "@id": "ex:price", "@type": "xsd:decimal" },
    "note": "ex:note",
    "comment": null,
    "x": "ex:x"
  }
})";

class Model : public testing::Test {
 protected:
  Model() {
    catalogue_.add("https://example.org/context.json", "context.json", std::string(kContext));
  }

  void load(const std::string& text, LoadOptions options = {}) {
    Loader(catalogue_, std::move(options))
        .load(
            text, "model.json", terms_, [this](const graph::Quad& quad) { quads_.push_back(quad); },
            &places_, report_);
  }
  // A document of one node with the context above; the body starts on line 4.
  static std::string node(const std::string& body) {
    return "{\n\"@context\": \"https://example.org/context.json\",\n\"@id\": \"ex:j1\",\n" + body +
           "}";
  }
  Problem only_problem() const {
    EXPECT_EQ(report_.problems().size(), 1u);
    return report_.problems().empty() ? Problem{} : report_.problems().front();
  }
  Problem thrown(const std::string& text, LoadOptions options = {}) {
    try {
      load(text, std::move(options));
    } catch (const Error& error) {
      return error.problems().front();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
  }
  std::string object(std::string_view property) {
    const graph::Id predicate = terms_.find_iri("https://example.org/" + std::string(property));
    for (const graph::Quad& quad : quads_) {
      if (quad.predicate == predicate) return terms_.to_string(quad.object);
    }
    return "none";
  }

  catalogue::Catalogue catalogue_ = catalogue::Catalogue::without_metamodels();
  graph::Terms terms_;
  graph::Places places_;
  Report report_;
  std::vector<graph::Quad> quads_;
};

TEST_F(Model, NotesTheLineOfEveryNodeAndProperty) {
  load(node("\"@type\": \"Joint\",\n\"parent\": {\n\"@id\": \"ex:base\",\n\"note\": \"fixed\" }"));
  const auto id = [&](const char* name) {
    return terms_.find_iri(std::string("https://example.org/") + name);
  };
  EXPECT_EQ(places_.find(id("j1")).line, 1u);
  EXPECT_EQ(places_.find(id("j1"), id("parent")).line, 5u);
  EXPECT_EQ(places_.find(id("j1"), id("parent")).file, "model.json");
  EXPECT_EQ(places_.find(id("base")).line, 5u);
  EXPECT_EQ(places_.find(id("base"), id("note")).line, 7u);
  EXPECT_TRUE(report_.problems().empty());
}

TEST_F(Model, AKeyThatNoContextDefinesIsAnError) {
  load(node("\"parnet\": \"ex:base\""));
  const Problem problem = only_problem();
  EXPECT_EQ(to_string(problem),
            "model.json:4: https://example.org/j1: no context defines \"parnet\"; did you mean "
            "\"parent\"?");
  EXPECT_EQ(problem.severity, Severity::kError);
  EXPECT_TRUE(quads_.empty());
}

TEST_F(Model, AKeyThatIsDefinedForAnotherTypeSaysForWhich) {
  load(node("\"@type\": \"Joint\", \"kilograms\": 1.5"));
  EXPECT_EQ(only_problem().remedy, "it is defined for nodes of type \"Mass\" only: add that type");
}

TEST_F(Model, LenientMakesItAWarning) {
  LoadOptions options;
  options.lenient = true;
  load(node("\"parnet\": \"ex:base\", \"note\": \"kept\""), options);
  EXPECT_EQ(only_problem().severity, Severity::kWarning);
  EXPECT_EQ(quads_.size(), 1u);
}

TEST_F(Model, ATermThatTheContextMapsToNullIsLeftOutOnPurpose) {
  load(node("\"comment\": \"for people only\""));
  EXPECT_TRUE(report_.problems().empty());
}

TEST_F(Model, ATypeThatNoContextDefinesIsAnError) {
  load(node("\"@type\": [\"Joint\",\n\"Jiont\"]"));
  EXPECT_EQ(only_problem().place.line, 5u);
  EXPECT_EQ(only_problem().what, "no context defines the type \"Jiont\"");
  EXPECT_EQ(only_problem().remedy, "did you mean \"Joint\"?");
}

TEST_F(Model, ATypeThatIsMerelyRelativeToTheBaseIsAnErrorToo) {
  LoadOptions options;
  options.base = "https://example.org/document";
  load(node("\"@type\": \"Jiont\""), options);
  EXPECT_EQ(only_problem().what, "no context defines the type \"Jiont\"");
}

TEST_F(Model, AValueThatMustBeATermIsOne) {
  load(node("\"axis\": \"x\""));
  EXPECT_TRUE(report_.problems().empty());
  EXPECT_EQ(object("axis"), "<https://example.org/x>");
  load(node("\"axis\": \"w\""));
  EXPECT_EQ(only_problem().what, "no context defines the value \"w\"");
}

TEST_F(Model, ARelativeIdentifierNeedsABase) {
  load("{\"@context\": \"https://example.org/context.json\",\n\"@id\": \"j1\", \"note\": \"n\"}");
  ASSERT_FALSE(report_.problems().empty());
  EXPECT_EQ(report_.problems().front().place.line, 2u);
  EXPECT_NE(report_.problems().front().what.find("relative IRI"), std::string::npos);
  EXPECT_TRUE(quads_.empty());
}

TEST_F(Model, WithABaseARelativeIdentifierIsFine) {
  LoadOptions options;
  options.base = "https://example.org/robot/";
  load(
      "{\"@context\": \"https://example.org/context.json\", \"@id\": \"j1\", \"parent\": \"../b\"}",
      options);
  EXPECT_TRUE(report_.problems().empty());
  EXPECT_EQ(object("parent"), "<https://example.org/b>");
}

TEST_F(Model, ValuesThatStandNowhereAreErrors) {
  load(
      "{\"@context\": \"https://example.org/context.json\", \"@graph\": [\n3,\n"
      "{\"@value\": \"free\"},\n{\"@list\": [1]}]}");
  ASSERT_EQ(report_.problems().size(), 3u);
  EXPECT_EQ(report_.problems()[0].place.line, 2u);
  EXPECT_EQ(report_.problems()[1].place.line, 3u);
  EXPECT_EQ(report_.problems()[2].place.line, 4u);
}

TEST_F(Model, AnIriWithForbiddenCharactersIsAnError) {
  load(node("\"parent\": \"ex:a b\""));
  EXPECT_NE(only_problem().what.find("no well-formed IRI"), std::string::npos);
  EXPECT_TRUE(quads_.empty());
}

TEST_F(Model, NumbersKeepTheirValueExactly) {
  load(
      node("\"@type\": \"Mass\", \"kilograms\": 0.30000000000000004, \"price\": 12.50,\n"
           "\"note\": 3, \"limits\": [1.0, -2.5e-3, 7]"));
  EXPECT_TRUE(report_.problems().empty());
  EXPECT_EQ(object("kilograms"),
            "\"0.30000000000000004\"^^<http://www.w3.org/2001/XMLSchema#double>");
  EXPECT_EQ(object("price"), "\"12.50\"^^<http://www.w3.org/2001/XMLSchema#decimal>");
  EXPECT_EQ(object("note"), "\"3\"^^<http://www.w3.org/2001/XMLSchema#integer>");
  const graph::Id first = terms_.find_iri("http://www.w3.org/1999/02/22-rdf-syntax-ns#first");
  std::vector<graph::Id> items;
  for (const graph::Quad& quad : quads_) {
    if (quad.predicate == first) items.push_back(quad.object);
  }
  EXPECT_EQ(items, (std::vector{terms_.real(1.0), terms_.real(-0.0025), terms_.integer(7)}));
}

// XML Schema's decimals have no exponents, those of JSON have.
TEST_F(Model, DecimalsWithAnExponentKeepTheirValue) {
  const std::pair<const char*, double> numbers[] = {
      {"1e-7", 1e-7}, {"-2.5e-3", -0.0025}, {"1e22", 1e22}, {"5e-324", 5e-324}, {"1e308", 1e308}};
  for (const auto& [text, value] : numbers) {
    quads_.clear();
    load(node("\"@type\": \"Mass\", \"price\": " + std::string(text)));
    EXPECT_TRUE(report_.problems().empty());
    const graph::Id price = terms_.find_iri("https://example.org/price");
    const auto quad = std::find_if(quads_.begin(), quads_.end(),
                                   [&](const graph::Quad& q) { return q.predicate == price; });
    ASSERT_NE(quad, quads_.end());
    EXPECT_EQ(terms_.number(quad->object), value) << terms_.to_string(quad->object);
  }
}

TEST_F(Model, AContextThatTheCatalogueLacksIsAnErrorAtThePlaceThatNamesIt) {
  const Problem problem =
      thrown("{\n \"@context\": [\n  \"https://example.org/contxt.json\"\n ]\n}");
  EXPECT_EQ(problem.place.line, 3u);
  EXPECT_EQ(problem.iri, "https://example.org/contxt.json");
  EXPECT_EQ(problem.code, "loading remote context failed");
  EXPECT_EQ(problem.remedy,
            "did you mean https://example.org/context.json? Otherwise give the directory that "
            "holds it with --catalog DIR");
}

TEST_F(Model, AFaultInsideAContextIsReportedInTheContext) {
  catalogue_.add("https://example.org/broken.json", "broken.json",
                 "{ \"@context\": {\n \"a\": { \"@id\": 3 } } }");
  const Problem problem = thrown("{\"@context\": \"https://example.org/broken.json\"}");
  EXPECT_EQ(problem.place.file, "broken.json");
  EXPECT_EQ(problem.place.line, 2u);
  EXPECT_EQ(problem.code, "invalid IRI mapping");
}

TEST_F(Model, AContextMayLieBesideTheModel) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "beside the model";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "own context.json") << kContext;
  const std::string text =
      "{\"@context\": \"own%20context.json\", \"@id\": \"ex:j1\", \"note\": \"n\"}";
  Loader(catalogue_)
      .load(
          text, (folder / "model.json").string(), terms_,
          [this](const graph::Quad& quad) { quads_.push_back(quad); }, nullptr, report_);
  EXPECT_EQ(object("note"), "\"n\"");
}

TEST_F(Model, BlankNodesOfTwoFilesAreDifferentNodes) {
  Loader loader(catalogue_);
  for (const char* file : {"a.json", "b.json"}) {
    loader.load(
        "{\"@context\": \"https://example.org/context.json\", \"@id\": \"_:n\", \"note\": 1}", file,
        terms_, [this](const graph::Quad& quad) { quads_.push_back(quad); }, nullptr, report_);
  }
  ASSERT_EQ(quads_.size(), 2u);
  EXPECT_NE(quads_[0].subject, quads_[1].subject);
}

TEST_F(Model, ContextsOfAllTypesApply) {
  load(R"({"@context": {
      "@version": 1.1, "ex": "https://example.org/",
      "A": {"@id": "ex:A", "@context": {"p": "ex:from-A", "q": "ex:from-A"}},
      "B": {"@id": "ex:B", "@context": {"p": "ex:from-B"}}},
    "@id": "ex:n", "@type": ["B", "A"], "p": 1, "q": 2})");
  EXPECT_TRUE(report_.problems().empty());
  EXPECT_EQ(object("from-B"), "\"1\"^^<http://www.w3.org/2001/XMLSchema#integer>");
  EXPECT_EQ(object("from-A"), "\"2\"^^<http://www.w3.org/2001/XMLSchema#integer>");
}

}  // namespace
}  // namespace sinew::jsonld
