#include "sinew/rdf/turtle/reader.h"

#include <gtest/gtest.h>

#include "sinew/base/error.h"
#include "sinew/rdf/turtle/writer.h"

namespace sinew::rdf {
namespace {

using graph::Quad;

class Reader : public testing::Test {
 protected:
  graph::Terms terms;

  std::vector<Quad> read(std::string_view text, Syntax syntax, const ReadOptions& options = {}) {
    std::vector<Quad> quads;
    read_rdf(text, syntax, options, terms,
             [&](const Quad& quad, std::size_t, std::size_t) { quads.push_back(quad); });
    return quads;
  }
  // As N-Quads, in the order of reading.
  std::string lines(std::string_view text, Syntax syntax, const ReadOptions& options = {}) {
    return write_rdf(read(text, syntax, options), Syntax::kNQuads, terms, {{}, false});
  }
  Problem problem(std::string_view text, Syntax syntax = Syntax::kTurtle) {
    try {
      read(text, syntax, {"model.ttl", "", {}});
    } catch (const Error& error) {
      return error.problems().front();
    }
    return {};
  }
};

TEST_F(Reader, UnderstandsEveryFormOfTurtle) {
  EXPECT_EQ(lines(R"(
    @prefix ex: <http://x/> .
    PREFIX : <http://y#>
    @base <http://b/dir/> .
    ex:a a ex:B ;            # a comment
         :p <c>, _:n, "t"@en, 'u'^^ex:T ; ;
         .
    _:n :p """two
lines""" .
  )",
                  Syntax::kTurtle),
            R"(<http://x/a> <http://www.w3.org/1999/02/22-rdf-syntax-ns#type> <http://x/B> .
<http://x/a> <http://y#p> <http://b/dir/c> .
<http://x/a> <http://y#p> _:b0 .
<http://x/a> <http://y#p> "t"@en .
<http://x/a> <http://y#p> "u"^^<http://x/T> .
_:b0 <http://y#p> "two\nlines" .
)");
}

TEST_F(Reader, ReadsBareNumbersAndBooleans) {
  EXPECT_EQ(lines("<x:s> <x:p> 1, -2.5, .5, 1.e3, 1E-3, true, false.", Syntax::kTurtle),
            R"(<x:s> <x:p> "1"^^<http://www.w3.org/2001/XMLSchema#integer> .
<x:s> <x:p> "-2.5"^^<http://www.w3.org/2001/XMLSchema#decimal> .
<x:s> <x:p> ".5"^^<http://www.w3.org/2001/XMLSchema#decimal> .
<x:s> <x:p> "1.e3"^^<http://www.w3.org/2001/XMLSchema#double> .
<x:s> <x:p> "1E-3"^^<http://www.w3.org/2001/XMLSchema#double> .
<x:s> <x:p> "true"^^<http://www.w3.org/2001/XMLSchema#boolean> .
<x:s> <x:p> "false"^^<http://www.w3.org/2001/XMLSchema#boolean> .
)");
}

TEST_F(Reader, TakesListsAndNestedNodesApart) {
  const std::string rdf = "http://www.w3.org/1999/02/22-rdf-syntax-ns#";
  EXPECT_EQ(lines("<x:s> <x:p> ( 1 [ <x:q> <x:o> ] ) .", Syntax::kTurtle),
            "_:b0 <" + rdf + "first> \"1\"^^<http://www.w3.org/2001/XMLSchema#integer> .\n" +
                "_:b0 <" + rdf + "rest> _:b1 .\n" +              //
                "_:b2 <x:q> <x:o> .\n" +                         //
                "_:b1 <" + rdf + "first> _:b2 .\n" +             //
                "_:b1 <" + rdf + "rest> <" + rdf + "nil> .\n" +  //
                "<x:s> <x:p> _:b0 .\n");
}

TEST_F(Reader, PutsTriplesIntoTheirGraphs) {
  EXPECT_EQ(lines("{ <x:a> <x:p> 'd' } <x:g> { <x:a> <x:p> 'g' . } GRAPH _:h { <x:a> <x:p> _:h }\n"
                  "<x:a> <x:p> 'e' .",
                  Syntax::kTriG),
            "<x:a> <x:p> \"d\" .\n<x:a> <x:p> \"g\" <x:g> .\n<x:a> <x:p> _:b0 _:b0 .\n"
            "<x:a> <x:p> \"e\" .\n");
}

TEST_F(Reader, PutsTheUnnamedGraphWhereItIsTold) {
  const ReadOptions options{"", "", terms.iri("x:model")};
  EXPECT_EQ(lines("<x:a> <x:p> 'd' .", Syntax::kTurtle, options),
            "<x:a> <x:p> \"d\" <x:model> .\n");
  EXPECT_EQ(lines("<x:a> <x:p> 'd' . <x:g> { <x:a> <x:p> 'g' }", Syntax::kTriG, options),
            "<x:a> <x:p> \"d\" <x:model> .\n<x:a> <x:p> \"g\" <x:g> .\n");
  EXPECT_EQ(lines("<x:a> <x:p> \"d\" .", Syntax::kNQuads, options),
            "<x:a> <x:p> \"d\" <x:model> .\n");
}

TEST_F(Reader, KeepsTheBlankNodesOfTwoDocumentsApart) {
  for (const Syntax syntax : {Syntax::kTurtle, Syntax::kNTriples}) {
    const auto first = read("_:a <x:p> _:a .", syntax), second = read("_:a <x:p> _:a .", syntax);
    EXPECT_EQ(first[0].subject, first[0].object);
    EXPECT_NE(first[0].subject, second[0].subject);
  }
}

TEST_F(Reader, LeavesAbsoluteIrisAsTheyAre) {
  EXPECT_EQ(lines("@base <http://b/> . <http://x/a/../b> <x:p> <../c> .", Syntax::kTurtle),
            "<http://x/a/../b> <x:p> <http://b/c> .\n");
}

TEST_F(Reader, SaysWhichPrefixesWereDeclared) {
  const Prefixes prefixes = read_rdf("@prefix a: <x:1> . PREFIX b: <x:2>", Syntax::kTurtle, {},
                                     terms, [](const Quad&, std::size_t, std::size_t) {});
  EXPECT_EQ(prefixes.list(), (std::vector<Prefix>{{"a", "x:1"}, {"b", "x:2"}}));
}

TEST_F(Reader, GivesThePlaceOfEachObject) {
  std::vector<std::pair<std::size_t, std::size_t>> places;
  read_rdf("\xEF\xBB\xBF<x:ä> <x:p> 1 ,\r\n  \"ö\" , 2 ; \r <x:p> \"\"\"a\nb\"\"\", 3 .\n",
           Syntax::kTurtle, {}, terms, [&](const Quad&, std::size_t line, std::size_t column) {
             places.emplace_back(line, column);
           });
  const std::vector<std::pair<std::size_t, std::size_t>> expected = {
      {1, 13}, {2, 3}, {2, 9}, {3, 8}, {4, 7}};
  EXPECT_EQ(places, expected);
}

TEST_F(Reader, ReadsNQuadsWithCommentsAndWithoutSpaces) {
  EXPECT_EQ(lines("# nothing\n\r\n<x:a><x:p>\"\\u00E4\\n\"@en<x:g>.# done\n \t_:x <x:p> _:x .",
                  Syntax::kNQuads),
            "<x:a> <x:p> \"ä\\n\"@en <x:g> .\n_:b0 <x:p> _:b0 .\n");
}

struct Fault {
  const char* text;
  const char* place_and_what;
};

TEST_F(Reader, PointsAtEachFaultOfTurtle) {
  const Fault faults[] = {
      {"<x:a> <x:p> <b> .", "1:13 <b> is relative and there is no base"},
      {"<x:a> <x:p> ex:b .", "1:13 the prefix \"ex:\" is not declared"},
      {"<x:a> <x:p> 1", "1:14 there is the end of the text where the statement should end"},
      {"<x:a>\n<x:p> 'a\n' .", "2:7 a string does not end on its line"},
      {"<x:a> <x:p> 'a", "1:13 a string does not end"},
      {"<x:a> <x:p> '''a'' .", "1:13 a string does not end"},
      {"<x:a> <x:p> 'ä\\x' .", "1:15 a string has \\ before 'x'"},
      {"<x:a> <x:p> '\\u12' .", "1:18 an escape has ''' instead of a hexadecimal digit"},
      {"<x:a> <x:p> '\\uD800' .", "1:15 U+D800 is not a character"},
      {"<x:a b> <x:p> 1 .", "1:5 an IRI holds a space"},
      {"<x:a", "1:1 an IRI does not end"},
      {"<x:\\u0020> <x:p> 1 .", "1:4 an escape stands for U+0020, which no IRI may hold"},
      {"<x:a> <x:p> 'a'@1 .", "1:16 \"1\" is not a language tag"},
      {"<x:a> 'p' 1 .", "1:7 there is ''' where a predicate should be"},
      {"'a' <x:p> 1 .", "1:1 there is ''' where a subject should be"},
      {"<x:a> <x:p> . ", "1:13 there is '.' where an object should be"},
      {"<x:a> <x:p> a .", "1:13 \"a\" stands where only a node can"},
      {"<x:a> <x:p> tru .", "1:13 the word \"tru\" means nothing here"},
      {"<x:a> <x:p> +x .", "1:14 a number has 'x' instead of a digit"},
      {"<x:a> <x:p> ( 1 .", "1:17 there is '.' where an object should be"},
      {"<x:a> <x:p> ( 1 ", "1:17 there is the end of the text where the end of a list should be"},
      {"<x:a> <x:p> [ <x:q> 1 .", "1:23 there is '.' where the end of a blank node should be"},
      {"[] .", "1:4 there is '.' where a predicate should be"},
      {"@prefix ex <x:> .", "1:9 a prefix does not end with a ':'"},
      {"@prefix ex: x .", "1:13 there is 'x' where the prefix's IRI should be"},
      {"@prefix ex: <x:>", "1:17 there is the end of the text where the directive should end"},
      {"@prefx ex: <x:> .", "1:1 a directive is neither @prefix nor @base"},
      {"PREFIX : <x:> :a%2 :b 1 .", "1:17 a name has % without two hexadecimal digits"},
      {"PREFIX : <x:> :a\\x :b 1 .", "1:17 a name has \\ before a character that takes no escape"},
      {"_:-a <x:p> 1 .", "1:3 a blank node's label begins with '-'"},
      {"<x:a> <x:p> \"a\xFF\" .", "1:15 the byte 0xFF is not UTF-8"},
      {"<x:a> { <x:a> <x:p> 1 }", "1:7 there is '{' where a predicate should be"},
  };
  for (const auto& [text, expected] : faults) {
    const Problem found = problem(text);
    EXPECT_EQ(std::to_string(found.place.line) + ":" + std::to_string(found.place.column) + " " +
                  found.what,
              expected);
    EXPECT_FALSE(found.remedy.empty()) << text;
    EXPECT_EQ(found.place.file, "model.ttl");
  }
}

TEST_F(Reader, PointsAtEachFaultOfTriGAndNQuads) {
  const std::tuple<Syntax, const char*, const char*> faults[] = {
      {Syntax::kTriG, "(1) { }", "1:5 there is '{' where a predicate should be"},
      {Syntax::kTriG, "GRAPH (1) { }",
       "1:7 a graph is named by a list or by a blank node with properties"},
      {Syntax::kTriG, "GRAPH <x:g> <x:a>",
       "1:13 there is '<' where the triples of the graph should be"},
      {Syntax::kTriG, "{ <x:a> <x:p> 1",
       "1:16 there is the end of the text where the end of the statement should be"},
      {Syntax::kTriG, "{ <x:a> <x:p> 1 .",
       "1:18 there is the end of the text where the end of a graph should be"},
      {Syntax::kTriG, "{ @prefix a: <x:> . }", "1:3 there is '@' where a subject should be"},
      {Syntax::kNQuads, "<x:a> <x:p> <b> .", "1:13 <b> is not absolute"},
      {Syntax::kNQuads, "<x:a> <x:p> 'b' .", "1:13 there is ''' where an object should be"},
      {Syntax::kNQuads, "<x:a> <x:p> <x:b> . <x:c>", "1:21 there is '<' behind a statement"},
      {Syntax::kNQuads, "<x:a>\n<x:p> <x:b> .",
       "1:6 there is the end of the line where a predicate should be"},
      {Syntax::kNQuads, "<x:a> <x:p> <x:b> \"g\" .",
       "1:19 there is '\"' where the end of the statement should be"},
      {Syntax::kNTriples, "<x:a> <x:p> <x:b> <x:g> .",
       "1:19 there is '<' where the end of the statement should be"},
      {Syntax::kNTriples, "<x:a> <x:p> \"1\"^^x:y .",
       "1:16 there is '^' where a literal's type should be"},
  };
  for (const auto& [syntax, text, expected] : faults) {
    const Problem found = problem(text, syntax);
    EXPECT_EQ(std::to_string(found.place.line) + ":" + std::to_string(found.place.column) + " " +
                  found.what,
              expected);
    EXPECT_FALSE(found.remedy.empty()) << text;
  }
}

TEST_F(Reader, LimitsNesting) {
  const auto nested = [](std::size_t depth) {
    std::string text = "<x:a> <x:p> ";
    for (std::size_t i = 0; i < depth; ++i) text += i % 2 == 0 ? "(" : "[ <x:q> ";
    text += "1";
    for (std::size_t i = depth; i-- > 0;) text += i % 2 == 0 ? ")" : "]";
    return text + " .";
  };
  EXPECT_EQ(problem(nested(kMaxNesting)).what, "");
  EXPECT_EQ(problem(nested(kMaxNesting + 1)).what, "[ ] and ( ) are nested more than 256 deep");
}

TEST_F(Reader, LimitsTheLengthOfATerm) {
  const std::string longest(kMaxTermBytes, 'x');
  const std::string what = "a term is longer than 67108864 bytes";
  EXPECT_EQ(problem("<x:a> <x:p> \"" + longest + "\" .").what, "");
  EXPECT_EQ(problem("<x:a> <x:p> \"" + longest + "y\" .").what, what);
  EXPECT_EQ(problem("<x:a> <x:p> \"\"\"" + longest + "\\n\"\"\" .").what, what);
  EXPECT_EQ(problem("<x:a> <x:p> <x:" + longest + "> .").what, what);
  EXPECT_EQ(problem("<x:a> <x:p> :" + longest + "y .").what, what);
  EXPECT_EQ(problem("<x:a> <x:p> _:" + longest + "y .").what, what);
}

TEST(SyntaxOfFile, GoesByTheEndOfTheName) {
  EXPECT_EQ(syntax_of_file("a.b/c.ttl"), Syntax::kTurtle);
  EXPECT_EQ(syntax_of_file("c.trig"), Syntax::kTriG);
  EXPECT_EQ(syntax_of_file("c.nt"), Syntax::kNTriples);
  EXPECT_EQ(syntax_of_file("c.nq"), Syntax::kNQuads);
  EXPECT_EQ(syntax_of_file("ttl"), std::nullopt);
}

}  // namespace
}  // namespace sinew::rdf
