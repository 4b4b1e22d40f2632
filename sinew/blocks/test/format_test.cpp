// The text's normal form, and the way into the graph and back.
#include "sinew/blocks/format.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "sinew/blocks/elaborate.h"
#include "sinew/blocks/graph.h"
#include "sinew/blocks/parser.h"
#include "sinew/data/embedded.h"

namespace sinew::blocks {
namespace {

std::string read(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Every .blocks file that ships or is test material.
std::vector<std::pair<std::string, std::string>> all_files() {
  std::vector<std::pair<std::string, std::string>> files = {
      {"geometry.blocks", std::string(data::embedded_file("blocks/geometry.blocks"))}};
  for (const char* folder :
       {SINEW_SOURCE_DIR "/examples", SINEW_SOURCE_DIR "/sinew/blocks/test/files"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (entry.path().extension() == ".blocks")
        files.emplace_back(entry.path().string(), read(entry.path()));
    }
  }
  return files;
}

TEST(Format, ChangesNothingWhenDoneTwice) {
  for (const auto& [name, text] : all_files()) {
    const std::string once = format(parse(text, name));
    EXPECT_EQ(format(parse(once, name)), once) << name;
  }
}

TEST(Format, KeepsEveryWordOfTheFile) {
  for (const auto& [name, text] : all_files()) {
    const Node before = parse(text, name), after = parse(format(before), name);
    // A prototype's fields are put into order, so compare formatted texts of the pieces.
    EXPECT_EQ(format(before), format(after)) << name;
    EXPECT_EQ(before.children.size(), after.children.size()) << name;
  }
}

TEST(Format, IsTheFormInWhichTheExamplesAndThePreludeAreWritten) {
  for (const auto& [name, text] : all_files()) {
    if (name.find("/test/") != std::string::npos) continue;
    EXPECT_EQ(format(parse(text, name)), text) << name << ": run sinew blocks fmt -i";
  }
}

TEST(Format, PutsShortListsOnOneLineAndFillsLongOnes) {
  const char* text =
      "algebraic a::Scalar{x,y}\nunits u::qudt,a{m=x m=y}\ndomain d::{semantic:A|B composite "
      "C={A,B}}";
  EXPECT_EQ(format(parse(text, "t")),
            "algebraic a :: Scalar{x, y}\n\n"
            "units u :: qudt, a { m = x, m = y }\n\n"
            "domain d :: {\n  semantic : A | B\n  composite C = { A, B }\n}\n");
}

TEST(Format, KeepsCommentsWhereTheyWere) {
  const char* text =
      "// before\nalgebraic a :: Vector{1}  // behind\n\nunits u :: qudt, a {\n  // in\n  m = 0 // "
      "entry\n  // last\n}\n// end\n";
  EXPECT_EQ(format(parse(text, "t")),
            "// before\nalgebraic a :: Vector{1} // behind\n\n"
            "units u :: qudt, a {\n  // in\n  m = 0 // entry\n  // last\n}\n\n// end\n");
}

TEST(Graph, HoldsAFileWithoutLoss) {
  for (const auto& [name, text] : all_files()) {
    const Node tree = parse(text, name);
    graph::Store store;
    const auto id = to_graph(tree, "https://example.org/x/", store);
    EXPECT_EQ(format(from_graph(store.view(), id, name)), format(tree)) << name;
  }
}

TEST(Graph, IsWrittenAsJsonLdAndReadBackWithoutLoss) {
  for (const auto& [name, text] : all_files()) {
    const Node tree = parse(text, name);
    const std::string json = to_jsonld(tree, default_base(name));
    EXPECT_EQ(format(from_jsonld(json, name + ".jsonld")), format(tree)) << name;
    EXPECT_EQ(to_jsonld(from_jsonld(json, name), default_base(name)), json) << name;
  }
}

TEST(Graph, MakesReferencesLinksBetweenNodes) {
  const Node tree = parse(
      "module m { algebraic a :: Vector{3} units u :: qudt, a { m = 0, m = 1, m = 2 } }\n"
      "dproto p :: geometry { semantic = Position coord = cartesian algebraic = m.a ddr = :: c99 { "
      "double[3] }\n"
      "dr = { 0 = 0, 1 = 1, 2 = 2 } units = m.u }",
      "t");
  graph::Store store;
  to_graph(tree, "https://example.org/x/", store);
  graph::Terms& terms = store.terms();
  const auto p = terms.find_iri("https://example.org/x/p"),
             a = terms.find_iri("https://example.org/x/m.a");
  const auto algebraic = terms.find_iri("https://w3id.org/sinew/data#algebraic");
  EXPECT_TRUE(store.view().contains(p, algebraic, a));
  EXPECT_TRUE(store.view().contains(terms.find_iri("https://example.org/x/m.u"), algebraic, a));
  EXPECT_EQ(
      terms.text(store.view().object(p, terms.find_iri("https://w3id.org/sinew/data#domain"))),
      "https://w3id.org/sinew/prelude/geometry");
}

TEST(Graph, CanBeWrittenByHandAsJsonLd) {
  const char* text = R"({
    "@context": ["https://w3id.org/sinew/data.json", {"my": "https://example.org/my/"}],
    "@id": "https://example.org/my/", "@type": "File",
    "entries": [
      {"@id": "my:three", "@type": "AlgebraicForm", "form": "Vector{3}"},
      {"@id": "my:metres", "@type": "Units", "ontology": "qudt", "algebraic": "my:three", "entries": [
        {"@type": "UnitEntry", "unit": "MilliM", "accessor": "0"},
        {"@type": "UnitEntry", "unit": "MilliM", "accessor": "1"},
        {"@type": "UnitEntry", "unit": "MilliM", "accessor": "2"}]},
      {"@id": "my:point", "@type": "Prototype", "domain": "https://w3id.org/sinew/prelude/geometry",
       "semantic": "Position", "coord": "cartesian", "algebraic": "my:three", "units": "my:metres",
       "representation": {"@type": "Representation", "language": "c99", "text": "float[3]"},
       "map": [{"@type": "MapEntry", "left": "0", "right": "0"}, {"@type": "MapEntry", "left": "1", "right": "1"},
               {"@type": "MapEntry", "left": "2", "right": "2"}]}]})";
  const Node tree = from_jsonld(text, "hand.jsonld");
  const auto library = load_library(tree);
  EXPECT_TRUE(library.find_prototype("point"));
  EXPECT_EQ(tree.children[0].text("name"), "three");
}

TEST(Graph, RefusesWhatTheLanguageDoesNotSay) {
  const auto message = [](const char* text) {
    try {
      from_jsonld(text, "t.jsonld");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const char* head =
      R"({"@context": ["https://w3id.org/sinew/data.json", {"@base": "https://example.org/"}], )";
  EXPECT_NE(message((std::string(head) + R"("@type": "Alias"})").c_str()).find("no data:File"),
            std::string::npos);
  EXPECT_NE(
      message((std::string(head) +
               R"("@id": "x", "@type": "File", "entries": [{"@type": "Alias", "unit": "m"}]})")
                  .c_str())
          .find("does not belong"),
      std::string::npos);
}

}  // namespace
}  // namespace sinew::blocks
