#include "sinew/rdf/results/formats.h"

#include <gtest/gtest.h>

#include "sinew/base/error.h"
#include "sinew/rdf/results/compare.h"

namespace sinew::rdf {
namespace {

using graph::Id;

class Formats : public testing::Test {
 protected:
  graph::Terms terms;

  // One row of everything that a term can be, one of nothing.
  ResultSet sample() {
    const Id blank = terms.fresh_blank();
    return {{"a", "b", "c"},
            {{terms.iri("http://x/joint1"), terms.literal("plain"), blank},
             {terms.literal("de", {}, "de-DE"), terms.integer(-3), terms.real(2.5e-3)},
             {terms.literal("<&\"'>, \\ \t\n end"), terms.boolean(true), blank},
             {Id{}, Id{}, Id{}},
             {terms.literal(""), terms.literal("x", "http://x/type"), Id{}}},
            {}};
  }
  std::string message(std::string_view text, ResultFormat format) {
    try {
      read_results(text, format, "file", terms);
    } catch (const Error& error) {
      const Place& place = error.problems().front().place;
      return std::to_string(place.line) + ":" + std::to_string(place.column) + " " +
             error.problems().front().what;
    }
    return "no error";
  }
};

TEST_F(Formats, ReadBackWhatTheyWrite) {
  const ResultSet results = sample();
  for (const ResultFormat format : {ResultFormat::kXml, ResultFormat::kJson, ResultFormat::kTsv}) {
    const std::string text = write_results(results, format, terms);
    const ResultSet again = read_results(text, format, "written", terms);
    EXPECT_TRUE(compare_results(results, again, true, terms)) << text;
    EXPECT_EQ(write_results(again, format, terms), text);
  }
}

TEST_F(Formats, AreWrittenAsTheStandardsHaveIt) {
  const ResultSet results = {
      {"x", "y"},
      {{terms.iri("http://x/a"), terms.integer(1)}, {Id{}, terms.literal("a, \"b\"", {}, "en")}},
      {}};
  EXPECT_EQ(write_results(results, ResultFormat::kCsv, terms),
            "x,y\r\nhttp://x/a,1\r\n,\"a, \"\"b\"\"\"\r\n");
  EXPECT_EQ(write_results(results, ResultFormat::kTsv, terms),
            "?x\t?y\n<http://x/a>\t1\n\t\"a, \\\"b\\\"\"@en\n");
  EXPECT_EQ(write_results(results, ResultFormat::kJson, terms), R"({
  "head": { "vars": [ "x", "y" ] },
  "results": { "bindings": [
    {
      "x": { "type": "uri", "value": "http://x/a" },
      "y": { "type": "literal", "value": "1", "datatype": "http://www.w3.org/2001/XMLSchema#integer" }
    },
    {
      "y": { "type": "literal", "value": "a, \"b\"", "xml:lang": "en" }
    }
  ] }
}
)");
  EXPECT_EQ(write_results(results, ResultFormat::kXml, terms),
            R"(<?xml version="1.0" encoding="UTF-8"?>
<sparql xmlns="http://www.w3.org/2005/sparql-results#">
  <head>
    <variable name="x"/>
    <variable name="y"/>
  </head>
  <results>
    <result>
      <binding name="x"><uri>http://x/a</uri></binding>
      <binding name="y"><literal datatype="http://www.w3.org/2001/XMLSchema#integer">1</literal></binding>
    </result>
    <result>
      <binding name="y"><literal xml:lang="en">a, &quot;b&quot;</literal></binding>
    </result>
  </results>
</sparql>
)");
}

TEST_F(Formats, GiveYesAndNo) {
  for (const bool answer : {true, false}) {
    const ResultSet results = {{}, {}, answer};
    for (const ResultFormat format : {ResultFormat::kXml, ResultFormat::kJson}) {
      const std::string text = write_results(results, format, terms);
      EXPECT_EQ(read_results(text, format, "written", terms).boolean, answer);
    }
    EXPECT_THROW(write_results(results, ResultFormat::kCsv, terms), Error);
    EXPECT_THROW(write_results(results, ResultFormat::kTsv, terms), Error);
  }
}

TEST_F(Formats, KeepRowsOfNoVariablesAtAll) {
  const ResultSet results = {{}, {{}, {}}, {}};
  for (const ResultFormat format :
       {ResultFormat::kXml, ResultFormat::kJson, ResultFormat::kCsv, ResultFormat::kTsv}) {
    const std::string text = write_results(results, format, terms);
    EXPECT_EQ(read_results(text, format, "written", terms).rows.size(), 2u) << text;
  }
}

TEST_F(Formats, RefuseToLoseACharacterThatXmlCannotHold) {
  const ResultSet results = {{"x"}, {{terms.literal("a\x01")}}, {}};
  EXPECT_THROW(write_results(results, ResultFormat::kXml, terms), Error);
  const std::string text = write_results(results, ResultFormat::kJson, terms);
  EXPECT_EQ(read_results(text, ResultFormat::kJson, "written", terms).rows, results.rows);
}

TEST_F(Formats, ReadQuotedCsv) {
  const ResultSet results =
      read_results("a,b\n\"1,\n\"\"2\"\"\",_:n\n,_:n\n", ResultFormat::kCsv, "file", terms);
  ASSERT_EQ(results.rows.size(), 2u);
  EXPECT_EQ(terms.text(results.rows[0][0]), "1,\n\"2\"");
  EXPECT_TRUE(terms.is_blank(results.rows[0][1]));
  EXPECT_EQ(results.rows[0][1], results.rows[1][1]);
  EXPECT_FALSE(results.rows[1][0]);
}

constexpr const char* kXmlHead =
    "<sparql xmlns=\"http://www.w3.org/2005/sparql-results#\"><head><variable name=\"x\"/></head>";

TEST_F(Formats, SayWhereTheTextIsWrong) {
  using enum ResultFormat;
  const std::string xml = kXmlHead;
  const std::tuple<ResultFormat, std::string, std::string> cases[] = {
      {kCsv, "", "1:1 there are no results"},
      {kCsv, "a,a\n", "1:3 the variable \"a\" is listed twice"},
      {kCsv, "a b\n", "1:1 \"a b\" is not the name of a variable"},
      {kCsv, "a,b\n1\n", "2:2 a row has 1 values for 2 variables"},
      {kCsv, "a\n1,2\n",
       "2:2 a row has more values than there are variables, or text behind a quote"},
      {kCsv, "a\n\"1\n", "2:1 a quoted value does not end"},
      {kCsv, "a\nä\"\n", "2:2 a quote stands within a value that is not quoted"},
      {kCsv, "a\n\xFF", "2:1 a byte is not UTF-8"},
      {kTsv, "", "1:1 there are no results"},
      {kTsv, "a\n", "1:1 there is 'a' where a variable should be"},
      {kTsv, "?a\nx\n", "2:1 there is 'x' where a term should be"},
      {kTsv, "?a\n<x>\n", "2:1 <x> is not absolute"},
      {kTsv, "?a\t?b\n1\n", "2:2 there is the end of the line where a tab should be"},
      {kTsv, "?a\n1 2\n", "2:2 there is ' ' where the end of the row should be"},
      {kTsv, "?a\n\"x\"^y\n", "2:4 a literal's type is missing"},
      {kJson, R"({"results":{"bindings":[]}})", "1:1 the results has no member \"head\""},
      {kJson, R"({"head":{}})", "1:1 there are no results"},
      {kJson, R"({"head":{"vars":["x"]},"results":{"bindings":[{"y":{}}]}})",
       "1:48 the variable \"y\" is bound but not listed in the head"},
      {kJson,
       R"({"head":{"vars":["x"]},"results":{"bindings":[{"x":{"type":"iri","value":"a"}}]}})",
       "1:52 \"iri\" is no type of terms"},
      {kJson,
       R"({"head":{"vars":["x"]},"results":{"bindings":[{"x":{"type":"uri","value":"a"}}]}})",
       "1:74 the IRI has no scheme"},
      {kXml, "<sparql>", "1:1 <sparql> cannot stand here"},
      {kXml, xml, "1:89 no element found"},
      {kXml, xml + "</sparql>", "1:98 there are no results"},
      {kXml, xml + "<results><result><binding name=\"x\"></binding></result></results></sparql>",
       "1:124 a binding has no value"},
      {kXml, xml + "<results><result><binding name=\"y\"/></result></results></sparql>",
       "1:106 the variable \"y\" is bound but not listed in the head"},
      {kXml, xml + "<boolean>yes</boolean></sparql>", "1:101 \"yes\" is no boolean"},
      {kXml, xml + "<results>x</results></sparql>", "1:98 there is text between the elements"},
      {kXml, "<!DOCTYPE sparql [<!ENTITY a \"b\">]>" + xml, "1:18 there is a document type"},
  };
  for (const auto& [format, text, expected] : cases) {
    EXPECT_EQ(message(text, format), expected) << text;
  }
}

TEST_F(Formats, LimitTheNumberOfVariables) {
  std::string text = "a";
  for (std::size_t i = 0; i < kMaxResultColumns; ++i) text += ",v" + std::to_string(i);
  const std::string expected = "there are more than 10000 variables";
  EXPECT_NE(message(text, ResultFormat::kCsv).find(expected), std::string::npos);
}

TEST_F(Formats, LimitTheNumberOfValues) {
  constexpr std::size_t kColumns = kMaxResultColumns - 1;
  std::string text = "v0";
  for (std::size_t i = 1; i < kColumns; ++i) text += ",v" + std::to_string(i);
  const std::string row(kColumns - 1, ',');
  for (std::size_t i = 0; i <= kMaxResultCells / (kColumns + 1); ++i) text += "\n" + row;
  EXPECT_EQ(message(text, ResultFormat::kCsv), "2002:1 there are more than 20000000 values");
}

TEST_F(Formats, AreKnownByTheEndOfTheName) {
  EXPECT_EQ(result_format_of_file("a/b.srx"), ResultFormat::kXml);
  EXPECT_EQ(result_format_of_file("b.srj"), ResultFormat::kJson);
  EXPECT_EQ(result_format_of_file("b.csv"), ResultFormat::kCsv);
  EXPECT_EQ(result_format_of_file("b.tsv"), ResultFormat::kTsv);
  EXPECT_EQ(result_format_of_file("b.txt"), std::nullopt);
}

}  // namespace
}  // namespace sinew::rdf
