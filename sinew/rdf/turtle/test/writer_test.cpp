#include "sinew/rdf/turtle/writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sinew/base/error.h"
#include "sinew/rdf/isomorphism/isomorphism.h"

namespace sinew::rdf {
namespace {

using graph::Id;
using graph::Quad;

class Writer : public testing::Test {
 protected:
  graph::Terms terms;
  const Prefixes prefixes{{"ex", "http://x/"}, {"unused", "http://unused/"}};

  std::vector<Quad> read(std::string_view text, Syntax syntax = Syntax::kTriG) {
    std::vector<Quad> quads;
    read_rdf(text, syntax, {}, terms,
             [&](const Quad& quad, std::size_t, std::size_t) { quads.push_back(quad); });
    return quads;
  }
  std::string turtle(std::string_view text) {
    return write_rdf(read(text), Syntax::kTurtle, terms, {prefixes});
  }
  std::string trig(std::string_view text) {
    return write_rdf(read(text), Syntax::kTriG, terms, {prefixes});
  }
};

TEST_F(Writer, LaysOutTurtleForPeople) {
  EXPECT_EQ(turtle(R"(PREFIX ex: <http://x/>
    ex:joint1 ex:value ( 1 2.5 ( ) ) ; a ex:Joint, ex:Revolute ; ex:name "Zwölf \"x\"\t"@de ;
      ex:pose [ ex:origin [ ] ; ex:angle 1.5e0 ] .
    ex:arm ex:first ex:joint1 . [] ex:of ex:arm . <http://other/x> ex:note "two\nlines" .)"),
            R"(@prefix ex: <http://x/> .

<http://other/x>
    ex:note """two
lines""" .

ex:arm ex:first ex:joint1 .

ex:joint1
    a ex:Joint, ex:Revolute ;
    ex:name "Zwölf \"x\"	"@de ;
    ex:pose [ ex:angle 1.5e0 ; ex:origin [] ] ;
    ex:value ( 1 2.5 () ) .

[] ex:of ex:arm .
)");
}

TEST_F(Writer, BreaksWhatDoesNotFitOnALine) {
  const std::string text = turtle(R"(PREFIX ex: <http://x/>
    ex:a ex:node [ ex:one "0123456789012345678901234567890123456789" ;
                   ex:two "0123456789012345678901234567890123456789" ] ;
         ex:list ( 1000000000 1000000001 1000000002 1000000003 1000000004 1000000005 1000000006
                   1000000007 1000000008 [ ex:in "the list" ] ) .)");
  EXPECT_EQ(text, R"(@prefix ex: <http://x/> .

ex:a
    ex:list (
        1000000000 1000000001 1000000002 1000000003 1000000004 1000000005 1000000006 1000000007
        1000000008
        [ ex:in "the list" ]
    ) ;
    ex:node [
        ex:one "0123456789012345678901234567890123456789" ;
        ex:two "0123456789012345678901234567890123456789"
    ] .
)");
}

TEST_F(Writer, LabelsNodesThatAreUsedTwiceOrInCycles) {
  EXPECT_EQ(turtle("_:a <x:p> _:b, _:c . _:b <x:p> _:c . _:x <x:q> _:y . _:y <x:q> _:x ."),
            R"(_:b0 <x:q> [ <x:q> _:b0 ] .

[]
    <x:p> [ <x:p> _:b1 ], _:b1 .
)");
}

TEST_F(Writer, WritesAListInFullUnlessItIsWellFormed) {
  const std::string rdf = "PREFIX rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> ";
  for (const char* text : {
           "<x:s> <x:p> _:l . _:l rdf:first 1, 2 ; rdf:rest rdf:nil .",  // two elements in a cell
           "<x:s> <x:p> _:l . _:l rdf:first 1 ; rdf:rest <x:other> .",   // another end
           "<x:s> <x:p> _:l . _:l rdf:first 1 ; rdf:rest _:l .",         // a cycle
           "<x:s> <x:p> _:l . _:l rdf:first 1 ; rdf:rest rdf:nil ; <x:q> 2 .",  // more properties
           "<x:s> <x:p> _:l, _:m . _:m rdf:first 1 ; rdf:rest _:l . _:l rdf:first 1 ; rdf:rest "
           "rdf:nil .",
       }) {
    const std::vector<Quad> quads = read(rdf + text);
    const std::string written = write_rdf(quads, Syntax::kTurtle, terms);
    EXPECT_NE(written.find("rdf-syntax-ns#first>"), std::string::npos) << written;
    EXPECT_TRUE(compare_quads(quads, read(written), terms)) << written;
  }
}

TEST_F(Writer, KeepsGraphsApart) {
  EXPECT_EQ(trig("PREFIX ex: <http://x/> ex:a ex:p ex:b . ex:g { ex:a ex:p _:n . _:n ex:q 1 }"
                 "ex:f { ex:a ex:p _:m } _:h { _:m ex:p [ ex:q 1 ] }"),
            R"(@prefix ex: <http://x/> .

ex:a ex:p ex:b .

ex:f {
    ex:a ex:p _:b0 .
}

ex:g {
    ex:a ex:p [ ex:q 1 ] .
}

_:b1 {
    _:b0 ex:p [ ex:q 1 ] .
}
)");
}

TEST_F(Writer, GivesTheSameTextWhateverTheOrderAndTheIds) {
  std::string nodes;
  std::vector<std::string> statements;
  for (int i = 0; i < 40; ++i) {
    statements.push_back("_:n" + std::to_string(i) + " <x:p> _:n" +
                         std::to_string((i * 7 + 3) % 40) + " ; <x:v> " + std::to_string(i % 5) +
                         " .\n");
  }
  std::mt19937 random(3);
  std::string first;
  for (int round = 0; round < 5; ++round) {
    std::string text;
    for (const std::string& statement : statements) text += statement;
    const std::vector<Quad> quads = read(text);
    const std::string written =
        write_rdf(quads, Syntax::kTurtle, terms) + write_rdf(quads, Syntax::kNTriples, terms);
    if (round == 0) first = written;
    EXPECT_EQ(written, first);
    std::ranges::shuffle(statements, random);
  }
}

TEST_F(Writer, NestsOnlySoDeepThatReadersCanFollow) {
  std::vector<Quad> quads;
  const Id p = terms.iri("x:p");
  Id node = terms.iri("x:root");
  for (int i = 0; i < 2000; ++i) {
    const Id next = terms.fresh_blank();
    quads.push_back({node, p, next});
    node = next;
  }
  const std::string text = write_rdf(quads, Syntax::kTurtle, terms);
  EXPECT_TRUE(compare_quads(quads, read(text), terms));
}

TEST_F(Writer, NestsListsWithinListsNoDeeperEither) {
  std::string text = "<x:s> <x:p> ";
  for (std::size_t i = 0; i < kMaxNesting; ++i) text += "( ";
  for (std::size_t i = 0; i < kMaxNesting; ++i) text += ") ";
  const std::vector<Quad> quads = read(text + ".");
  EXPECT_TRUE(compare_quads(quads, read(write_rdf(quads, Syntax::kTurtle, terms)), terms));
}

TEST_F(Writer, WritesCanonicalSortedLines) {
  const std::vector<Quad> quads = read(
      "<x:b> <x:p> \"tab\\there\\r\\n\\\"\\\\\" . <x:a> <x:p> 1 . <x:b> <x:p> 'x'@en . <x:a> <x:p> "
      "1 .");
  EXPECT_EQ(write_rdf(quads, Syntax::kNTriples, terms),
            "<x:a> <x:p> \"1\"^^<http://www.w3.org/2001/XMLSchema#integer> .\n"
            "<x:b> <x:p> \"tab\there\\r\\n\\\"\\\\\" .\n"
            "<x:b> <x:p> \"x\"@en .\n");
  EXPECT_TRUE(write_rdf(quads, Syntax::kNTriples, terms, {{}, false}).starts_with("<x:b>"));
}

TEST_F(Writer, RefusesWhatTheSyntaxCannotSay) {
  const Id a = terms.iri("x:a"), bad = terms.iri("x:a b"), relative = terms.iri("a");
  for (const Syntax syntax : {Syntax::kTurtle, Syntax::kNTriples}) {
    EXPECT_THROW(write_rdf(std::vector<Quad>{{a, a, a, a}}, syntax, terms), Error);
    EXPECT_THROW(write_rdf(std::vector<Quad>{{a, a, bad}}, syntax, terms), Error);
    EXPECT_THROW(write_rdf(std::vector<Quad>{{a, a, relative}}, syntax, terms), Error);
  }
}

TEST_F(Writer, ShortensOnlyLiteralsThatReadBackTheSame) {
  const std::string xsd = "http://www.w3.org/2001/XMLSchema#";
  const std::tuple<const char*, const char*, bool> cases[] = {
      {"1", "integer", true},      {"-01", "integer", true}, {"1.0", "integer", false},
      {" 1", "integer", false},    {"1.5", "decimal", true}, {"1", "decimal", false},
      {"1.", "decimal", false},    {".5", "decimal", true},  {"1e3", "double", true},
      {"1.e3", "double", true},    {".e3", "double", false}, {"1.5", "double", false},
      {"INF", "double", false},    {"1e", "double", false},  {"true", "boolean", true},
      {"1", "boolean", false},     {"", "integer", false},   {"1", "int", false},
      {"+.5E-07", "double", true}, {"-", "integer", false},  {".", "decimal", false},
  };
  for (const auto& [text, type, bare] : cases) {
    const std::vector<Quad> quads = {
        {terms.iri("x:s"), terms.iri("x:p"), terms.literal(text, xsd + type)}};
    const std::string written = write_rdf(quads, Syntax::kTurtle, terms);
    EXPECT_EQ(written.find('"') == std::string::npos, bare) << written;
    EXPECT_EQ(read(written), quads) << written;
  }
}

TEST_F(Writer, CollectsEveryQuadOfAView) {
  graph::Store store;
  const Id a = store.terms().iri("x:a"), g = store.terms().iri("x:g");
  store.add({a, a, a});
  store.add({a, a, a, g});
  store.add({a, a, g, g});
  EXPECT_EQ(write_rdf(quads_of(store.view()), Syntax::kNQuads, store.terms()),
            "<x:a> <x:a> <x:a> .\n<x:a> <x:a> <x:a> <x:g> .\n<x:a> <x:a> <x:g> <x:g> .\n");
}

}  // namespace
}  // namespace sinew::rdf
