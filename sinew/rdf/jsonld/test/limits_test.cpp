// Every limit is an error with a place, reached in bounded time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sinew/graph/store.h"
#include "sinew/rdf/jsonld/load.h"
#include "sinew/rdf/jsonld/processor.h"

namespace sinew::jsonld {
namespace {

class Limits : public testing::Test {
 protected:
  Problem fault(const std::string& text) {
    try {
      Processor processor(catalogue_);
      const json::Document document = json::read(text, "file.json");
      graph::Terms terms;
      processor.to_rdf(document, "https://example.org/file.json", terms, [](const graph::Quad&) {});
    } catch (const Error& error) {
      return error.problems().front();
    }
    return {};
  }
  void context(const std::string& name, const std::string& content) {
    catalogue_.add("https://example.org/" + name, name, "{\"@context\": " + content + "}");
  }
  catalogue::Catalogue catalogue_ = catalogue::Catalogue::without_metamodels();
};

TEST_F(Limits, AContextThatIncludesItself) {
  context("a", "\"b\"");
  context("b", "[{}, \"a\"]");
  const Problem problem = fault("{\"@context\": \"a\"}");
  EXPECT_EQ(problem.code, "context overflow");
  EXPECT_EQ(problem.place.file, "b");
  EXPECT_NE(problem.what.find("includes itself"), std::string::npos);
}

TEST_F(Limits, TheSameContextTwiceIsFine) {
  context("a", "{\"p\": \"https://example.org/p\"}");
  EXPECT_EQ(fault("{\"@context\": [\"a\", \"a\"], \"p\": 1}").what, "");
}

TEST_F(Limits, ContextsThatIncludeEachOtherTooDeep) {
  for (std::size_t i = 0; i <= kMaxNestedRemoteContexts; ++i) {
    context(fmt::format("c{}", i), fmt::format("\"c{}\"", i + 1));
  }
  context(fmt::format("c{}", kMaxNestedRemoteContexts + 1), "{}");
  EXPECT_EQ(fault("{\"@context\": \"c0\"}").code, "context overflow");
  EXPECT_EQ(fault("{\"@context\": \"c3\"}").what, "");
}

TEST_F(Limits, ContextsThatIncludeEachOtherTooOften) {
  context("c0", "{}");
  for (int i = 1; i < 40; ++i)
    context(fmt::format("c{}", i), fmt::format("[\"c{0}\", \"c{0}\"]", i - 1));
  const Problem problem = fault("{\"@context\": \"c39\"}");
  EXPECT_EQ(problem.code, "context overflow");
  EXPECT_NE(problem.what.find("more than 1000000 contexts"), std::string::npos);
}

TEST_F(Limits, AScopedContextMayReferToItself) {
  context("a", "{\"p\": {\"@id\": \"https://example.org/p\", \"@context\": \"a\"}}");
  EXPECT_EQ(fault("{\"@context\": \"a\", \"p\": {\"p\": {\"p\": 1}}}").what, "");
}

// Each node doubles what its parent had; without a bound on memory this would not end.
TEST_F(Limits, TermsThatGrowExponentially) {
  std::string text = "{\"@context\": {\"@version\": 1.1, \"t0\": \"https://example.org/";
  text += std::string(1000, 'x') + "#\"";
  for (int i = 1; i < 3000; ++i)
    text += fmt::format(", \"t{}\": \"t{}:{}#\"", i, i - 1, std::string(1000, 'y'));
  const Problem problem = fault(text + "}}");
  EXPECT_EQ(problem.code, "loading document failed");
  EXPECT_NE(problem.what.find("1 GiB"), std::string::npos);
}

TEST_F(Limits, TermsThatDependOnEachOtherInALongChain) {
  std::string text = "{\"@context\": {\"t0\": \"https://example.org/#\"";
  for (int i = 100'000; i > 0; --i) text += fmt::format(", \"t{}:\": \"t{}:x\"", i, i - 1);
  EXPECT_EQ(fault(text + "}}").what, "");  // each is looked up as a compact IRI
  text = "{\"@context\": {";
  for (int i = 100'000; i > 0; --i) text += fmt::format("\"t{}\": \"t{}:#\", ", i, i - 1);
  const Problem problem = fault(text + "\"t0\": \"https://example.org/#\"}}");
  EXPECT_EQ(problem.code, "context overflow");
  EXPECT_NE(problem.what.find("chain of more than 500"), std::string::npos);
}

TEST_F(Limits, AModelThatIsWrongEverywhereIsReportedQuickly) {
  std::string text = "{\"@context\": {\"a\": \"https://example.org/a\"";
  for (int i = 0; i < 2000; ++i)
    text += fmt::format(", \"term{}\": \"https://example.org/{}\"", i, i);
  text += "}, \"@id\": \"https://example.org/n\"";
  for (int i = 0; i < 50'000; ++i) text += fmt::format(", \"wrong{}\": 1", i);
  graph::Terms terms;
  Report report;
  Loader(catalogue_)
      .load(
          text + "}", "model.json", terms, [](const graph::Quad&) {}, nullptr, report);
  EXPECT_TRUE(report.has_errors());
}

TEST_F(Limits, FlatteningManyValuesTakesLinearTime) {
  std::string text = "{\"https://example.org/p\": [0";
  for (int i = 1; i < 100'000; ++i) text += fmt::format(", {}", i);
  const json::Document document = json::read(text + "]}", "file.json");
  Processor processor(catalogue_);
  const json::Value flat = processor.flatten(document, "https://example.org/", {});
  EXPECT_EQ(flat.items()[0].find("https://example.org/p")->items().size(), 100'000u);
}

TEST_F(Limits, AnObjectWithManyKeysTakesLinearTime) {
  std::string text = "{\"@id\": \"https://example.org/n\"";
  for (int i = 0; i < 200'000; ++i) text += fmt::format(", \"https://example.org/p{}\": {}", i, i);
  EXPECT_EQ(fault(text + "}").what, "");
}

}  // namespace
}  // namespace sinew::jsonld
