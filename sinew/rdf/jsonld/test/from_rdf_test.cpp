// Graphs that are not what they look like at first: lists that are shared, broken or in a circle.
#include "sinew/rdf/jsonld/from_rdf.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sinew/graph/store.h"
#include "sinew/rdf/isomorphism/isomorphism.h"
#include "sinew/rdf/json/writer.h"
#include "sinew/rdf/jsonld/load.h"
#include "sinew/rdf/jsonld/write.h"
#include "sinew/rdf/turtle/reader.h"

namespace sinew::jsonld {
namespace {

using graph::Quad;

class FromQuads : public testing::Test {
 protected:
  // TriG with prefix ":" for https://example.org/.
  void read(const std::string& trig) {
    const std::string prefixes =
        "@prefix : <https://example.org/> .\n"
        "@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .\n";
    rdf::read_rdf(prefixes + trig, rdf::Syntax::kTriG, {"graph.trig", "", {}}, terms_,
                  [this](const Quad& quad, std::size_t, std::size_t) { quads_.push_back(quad); });
  }
  std::string expanded() {
    json::Arena arena;
    const Options options;
    return json::to_text(FromRdf(terms_, options, arena).document(quads_));
  }
  std::string written() {
    WriteOptions options;
    options.prefixes = {{"ex", "https://example.org/"}};
    return Writer(catalogue_, options).write(quads_, terms_);
  }
  // What is written, read again, says the same.
  void expect_round_trip() {
    std::vector<Quad> again;
    Report report;
    const std::string text = written();
    Loader(catalogue_)
        .load(
            text, "written", terms_, [&](const Quad& q) { again.push_back(q); }, nullptr, report);
    EXPECT_TRUE(report.problems().empty()) << to_string(report.problems().front());
    EXPECT_EQ(rdf::compare_quads(quads_, again, terms_).difference, "") << text;
  }
  catalogue::Catalogue catalogue_ = catalogue::Catalogue::without_metamodels();
  graph::Terms terms_;
  std::vector<Quad> quads_;
};

TEST_F(FromQuads, AWellFormedListIsAList) {
  read(":s :p ( 1 ( ) :o ) .");
  EXPECT_EQ(expanded(),
            R"([{"@id":"https://example.org/s","https://example.org/p":[{"@list":[)"
            R"({"@value":"1","@type":"http://www.w3.org/2001/XMLSchema#integer"},{"@list":[]},)"
            R"({"@id":"https://example.org/o"}]}]}])");
  expect_round_trip();
}

TEST_F(FromQuads, AListThatIsUsedTwiceKeepsItsCells) {
  read(":s :p _:l . :t :p _:l . _:l rdf:first 1 ; rdf:rest rdf:nil .");
  EXPECT_EQ(expanded().find("@list\":[{"), std::string::npos);
  expect_round_trip();
}

TEST_F(FromQuads, AListWithMoreThanItemsKeepsItsCells) {
  read(":s :p _:l . _:l rdf:first 1 ; rdf:rest rdf:nil ; :note \"mine\" .");
  expect_round_trip();
}

TEST_F(FromQuads, AListInACircleIsNotLost) {
  read("_:l rdf:first _:l ; rdf:rest rdf:nil .");
  EXPECT_NE(expanded(), "[]");
  expect_round_trip();
}

TEST_F(FromQuads, TwoListsThatHoldEachOtherAreNotLost) {
  read("_:a rdf:first _:b ; rdf:rest rdf:nil . _:b rdf:first _:a ; rdf:rest rdf:nil .");
  expect_round_trip();
}

TEST_F(FromQuads, AListStaysInItsGraph) {
  read(":s :p _:l . :g { _:l rdf:first 1 ; rdf:rest rdf:nil . }");
  expect_round_trip();
}

TEST_F(FromQuads, ABlankNodeThatIsUsedOnceIsWrittenWhereItIsUsed) {
  read(":s :p [ :q [ :r 1 ] ] .");
  EXPECT_EQ(written(), R"({
  "@context": { "ex": "https://example.org/" },
  "@id": "ex:s",
  "ex:p": {
    "ex:q": { "ex:r": 1 }
  }
}
)");
  expect_round_trip();
}

TEST_F(FromQuads, OthersGetShortLabels) {
  read(":s :p _:x . :t :p _:x . _:x :p :s .");
  EXPECT_NE(written().find("\"_:b0\""), std::string::npos);
  expect_round_trip();
}

TEST_F(FromQuads, BlankNodesInACircleAreNotLost) {
  read("_:a :p _:b . _:b :p _:a . :s :p _:c . _:c :p _:c .");
  expect_round_trip();
}

TEST_F(FromQuads, ABlankNodeThatIsAListItemOfItselfIsNotLost) {
  read("_:x :p ( 1 _:x ) .");
  expect_round_trip();
}

TEST_F(FromQuads, SortedTextDoesNotDependOnTheOrderOfTheQuads) {
  read(
      ":s :p _:x, _:y ; :q ( 2 _:x ) . _:x :p 1, \"a\"@en . _:y :p _:x . :g { :s :p _:y . _:z :p 2 "
      ". }");
  WriteOptions options;
  options.sorted = true;
  Writer writer(catalogue_, options);
  const std::string text = writer.write(quads_, terms_);
  for (int turn = 0; turn < 20; ++turn) {
    std::rotate(quads_.begin(), quads_.begin() + 5, quads_.end());
    std::swap(quads_[0], quads_[static_cast<std::size_t>(turn) % quads_.size()]);
    EXPECT_EQ(writer.write(quads_, terms_), text);
  }
}

TEST_F(FromQuads, ALongChainOfBlankNodesCanBeReadAgain) {
  std::string chain = ":s :p _:n0 .";
  for (int i = 0; i < 1000; ++i) {
    chain += " _:n" + std::to_string(i) + " :p _:n" + std::to_string(i + 1) + " .";
  }
  read(chain + " _:n1000 :p 1 .");
  expect_round_trip();
}

TEST_F(FromQuads, ListsThatAreNestedTooDeepAreAnError) {
  std::string lists = ":s :p _:l0 .";
  for (int i = 0; i < 100'000; ++i) {
    lists += " _:l" + std::to_string(i) + " rdf:first _:l" + std::to_string(i + 1) +
             " ; rdf:rest rdf:nil .";
  }
  read(lists + " _:l100000 rdf:first 1 ; rdf:rest rdf:nil .");
  EXPECT_THROW(written(), Error);
  std::reverse(quads_.begin(), quads_.end());
  EXPECT_THROW(expanded(), Error);
}

TEST_F(FromQuads, ABrokenJsonLiteralIsAnError) {
  read(":s :p \"{\"^^rdf:JSON .");
  try {
    expanded();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.problems().front().code, "invalid JSON literal");
  }
}

}  // namespace
}  // namespace sinew::jsonld
