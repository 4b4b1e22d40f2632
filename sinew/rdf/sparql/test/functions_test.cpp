// Expressions, functions and casts (SPARQL 1.1, section 17): what each is worth. "-" is an error.
#include <gtest/gtest.h>

#include <regex>

#include "sinew/rdf/sparql/test/table.h"

namespace sinew::rdf::sparql {
namespace {

struct Case {
  const char* expression;
  const char* value;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.expression; }

class Functions : public testing::TestWithParam<Case> {};

TEST_P(Functions, AreWorth) {
  Table table;
  QueryOptions options;
  options.base = "http://e/";
  const std::string text = std::string("SELECT (") + GetParam().expression + " AS ?value) {}";
  EXPECT_EQ(table.rows(text, options), (Rows{{GetParam().value}}));
}

INSTANTIATE_TEST_SUITE_P(
    Logic, Functions,
    testing::Values(Case{"true && false", "false"}, Case{"false && (1/0)", "false"},
                    Case{"true && (1/0 = 1)", "-"}, Case{"true || (1/0 = 1)", "true"},
                    Case{"!true", "false"}, Case{"!\"\"", "true"}, Case{"!0", "true"},
                    Case{"!:iri", "-"}, Case{"IF(1 < 2, \"a\", 1/0)", "\"a\""},
                    Case{"IF(1/0, 1, 2)", "-"}, Case{"COALESCE(1/0, ?none, 3)", "3"},
                    Case{"COALESCE()", "-"}, Case{"2 IN (1, 2, 3)", "true"},
                    Case{"2 IN (1/0, 2)", "true"}, Case{"2 IN (1/0, 3)", "-"},
                    Case{"2 NOT IN ()", "true"}, Case{"BOUND(?none)", "false"}));

INSTANTIATE_TEST_SUITE_P(
    Comparison, Functions,
    testing::Values(Case{"1 = 1.0", "true"}, Case{"1 = 1e0", "true"}, Case{"\"1\" = 1", "false"},
                    Case{"\"a\" = \"a\"@en", "false"}, Case{"\"a\"@en = \"a\"@EN", "true"},
                    Case{":a = :a", "true"}, Case{":a != :b", "true"}, Case{":a < :b", "-"},
                    Case{"\"a\"^^:t = \"a\"^^:t", "true"}, Case{"\"a\"^^:t = \"b\"^^:t", "-"},
                    Case{"1 < 1.5", "true"}, Case{"\"a\" < \"b\"", "true"},
                    Case{"false < true", "true"}, Case{"0.1 + 0.2 = 0.3", "true"},
                    Case{"1e0/0 = 1e0/0", "true"},
                    Case{"9007199254740993 = 9007199254740992", "false"},
                    Case{"sameTerm(1, 1.0)", "false"}, Case{"sameTerm(:a, :a)", "true"}));

INSTANTIATE_TEST_SUITE_P(
    Arithmetic, Functions,
    testing::Values(Case{"1 + 2", "3"}, Case{"1 - 2.5", "-1.5"},
                    Case{"2 * 3e0", "\"6.0E0\"^^xsd:double"}, Case{"7 / 2", "3.5"},
                    Case{"1 / 3", "0.333333333333333333"}, Case{"1 / 0", "-"},
                    Case{"1e0 / 0", "\"INF\"^^xsd:double"}, Case{"-(1)", "-1"}, Case{"+(1)", "1"},
                    Case{"1-1", "0"}, Case{"2+3*4", "14"}, Case{"10-2-3", "5"},
                    Case{"\"1\" + 1", "-"},
                    Case{"123456789012345678901234567890 + 1", "123456789012345678901234567891"},
                    Case{"ABS(-2.5)", "2.5"}, Case{"ROUND(2.5)", "3"}, Case{"ROUND(-2.5)", "-2"},
                    Case{"CEIL(-1.5)", "-1"}, Case{"FLOOR(-1.5)", "-2"},
                    Case{"ROUND(2.4e0)", "\"2.0E0\"^^xsd:double"}));

INSTANTIATE_TEST_SUITE_P(
    Strings, Functions,
    testing::Values(
        Case{"STRLEN(\"Grüße\")", "5"}, Case{"SUBSTR(\"Grüße\", 3, 2)", "\"üß\""},
        Case{"SUBSTR(\"abc\", 0)", "\"abc\""}, Case{"SUBSTR(\"abc\", 2)", "\"bc\""},
        Case{"UCASE(\"straße\")", "\"STRASSE\""}, Case{"LCASE(\"ÄB\"@de)", "\"äb\"@de"},
        Case{"CONCAT(\"a\"@en, \"b\"@en)", "\"ab\"@en"}, Case{"CONCAT(\"a\"@en, \"b\")", "\"ab\""},
        Case{"STRSTARTS(\"foobar\"@en, \"foo\")", "true"},
        Case{"STRSTARTS(\"foobar\", \"foo\"@en)", "-"},
        Case{"STRENDS(\"foobar\", \"bar\")", "true"}, Case{"CONTAINS(\"foobar\", \"ob\")", "true"},
        Case{"STRBEFORE(\"abc\"@en, \"b\")", "\"a\"@en"},
        Case{"STRBEFORE(\"abc\"@en, \"x\")", "\"\""}, Case{"STRAFTER(\"abc\", \"b\")", "\"c\""},
        Case{"STRAFTER(\"abc\", \"\")", "\"abc\""},
        Case{"ENCODE_FOR_URI(\"a b/ü\")", "\"a%20b%2F%C3%BC\""},
        Case{"LANGMATCHES(\"en-GB\", \"en\")", "true"},
        Case{"LANGMATCHES(\"en\", \"en-GB\")", "false"}, Case{"LANGMATCHES(\"\", \"*\")", "false"},
        Case{"REGEX(\"Alice\", \"^ali\", \"i\")", "true"},
        Case{"REGEX(\"a.c\", \"a.c\", \"q\")", "true"}, Case{"REGEX(\"abc\", \"a(\")", "-"},
        Case{"REPLACE(\"abcd\", \"b(.)\", \"[$1]\")", "\"a[c]d\""},
        Case{"REPLACE(\"abc\"@en, \"b\", \"Z\")", "\"aZc\"@en"},
        Case{"REPLACE(\"abc\", \"x*\", \"-\")", "-"},
        Case{"MD5(\"abc\")", "\"900150983cd24fb0d6963f7d28e17f72\""},
        Case{"SHA1(\"abc\")", "\"a9993e364706816aba3e25717850c26c9cd0d89d\""},
        Case{"SHA256(\"\")",
             "\"e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855\""}));

INSTANTIATE_TEST_SUITE_P(
    Terms, Functions,
    testing::Values(
        Case{"isIRI(:a)", "true"}, Case{"isURI(\"a\")", "false"}, Case{"isLITERAL(1)", "true"},
        Case{"isBLANK(BNODE())", "true"}, Case{"isNUMERIC(\"1\")", "false"},
        Case{"isNUMERIC(\"x\"^^xsd:integer)", "false"}, Case{"STR(:a)", "\"http://e/a\""},
        Case{"STR(1.50)", "\"1.50\""}, Case{"LANG(\"a\"@en)", "\"en\""}, Case{"LANG(1)", "\"\""},
        Case{"LANG(:a)", "-"}, Case{"DATATYPE(1)", "<http://www.w3.org/2001/XMLSchema#integer>"},
        Case{"DATATYPE(\"a\"@en)", "<http://www.w3.org/1999/02/22-rdf-syntax-ns#langString>"},
        Case{"IRI(\"a\")", ":a"}, Case{"IRI(\"http://x/y z\")", "-"}, Case{"URI(:a)", ":a"},
        Case{"STRDT(\"1\", xsd:integer)", "1"}, Case{"STRDT(1, xsd:integer)", "-"},
        Case{"STRLANG(\"a\", \"en\")", "\"a\"@en"}, Case{"BNODE(\"a\") = BNODE(\"a\")", "true"},
        Case{"BNODE() = BNODE()", "false"}));

INSTANTIATE_TEST_SUITE_P(
    Casts, Functions,
    testing::Values(
        Case{"xsd:integer(\" 12 \")", "12"}, Case{"xsd:integer(2.9)", "2"},
        Case{"xsd:integer(-2.9e0)", "-2"}, Case{"xsd:integer(\"2.9\")", "-"},
        Case{"xsd:integer(true)", "1"}, Case{"xsd:decimal(\"1.50\")", "1.5"},
        Case{"xsd:decimal(1e-3)", "0.001"}, Case{"xsd:decimal(1e0/0)", "-"},
        Case{"xsd:double(\"1e3\")", "\"1.0E3\"^^xsd:double"}, Case{"xsd:boolean(\"0\")", "false"},
        Case{"xsd:boolean(0e0)", "false"}, Case{"xsd:string(1e0)", "\"1\""},
        Case{"xsd:string(1e7)", "\"1.0E7\""}, Case{"xsd:string(01.50)", "\"1.5\""},
        Case{"xsd:string(:a)", "\"http://e/a\""},
        Case{"xsd:dateTime(\"2024-02-29T12:00:00Z\")", "\"2024-02-29T12:00:00Z\"^^xsd:dateTime"},
        Case{"xsd:dateTime(\"2023-02-29T12:00:00Z\")", "-"},
        Case{"xsd:date(\"2024-02-29T12:00:00Z\"^^xsd:dateTime)", "\"2024-02-29Z\"^^xsd:date"}));

#define TIME "\"2011-01-10T14:45:13.815-05:00\"^^xsd:dateTime"
INSTANTIATE_TEST_SUITE_P(
    Times, Functions,
    testing::Values(
        Case{"YEAR(" TIME ")", "2011"}, Case{"MONTH(" TIME ")", "1"}, Case{"DAY(" TIME ")", "10"},
        Case{"HOURS(" TIME ")", "14"}, Case{"MINUTES(" TIME ")", "45"},
        Case{"SECONDS(" TIME ")", "13.815"},
        Case{"TIMEZONE(" TIME ")", "\"-PT5H\"^^xsd:dayTimeDuration"},
        Case{"TZ(" TIME ")", "\"-05:00\""},
        Case{"TZ(\"2011-01-10T14:45:13\"^^xsd:dateTime)", "\"\""},
        Case{"TIMEZONE(\"2011-01-10T14:45:13\"^^xsd:dateTime)", "-"}, Case{"NOW() = NOW()", "true"},
        Case{"\"2024-01-01T00:00:00Z\"^^xsd:dateTime = \"2024-01-01T01:00:00+01:00\"^^xsd:dateTime",
             "true"},
        Case{"\"2024-01-01T00:00:00Z\"^^xsd:dateTime < \"2024-01-01T05:00:00\"^^xsd:dateTime", "-"},
        Case{"\"2024-03-01T00:00:00Z\"^^xsd:dateTime - \"2024-02-28T00:00:00Z\"^^xsd:dateTime",
             "\"P2D\"^^xsd:dayTimeDuration"},
        Case{"\"2024-01-31T10:00:00Z\"^^xsd:dateTime + \"P1M\"^^xsd:yearMonthDuration",
             "\"2024-02-29T10:00:00Z\"^^xsd:dateTime"},
        Case{"\"23:30:00\"^^xsd:time + \"PT1H\"^^xsd:dayTimeDuration", "\"00:30:00\"^^xsd:time"},
        Case{"\"PT1H\"^^xsd:dayTimeDuration * 1.5", "\"PT1H30M\"^^xsd:dayTimeDuration"},
        Case{"\"P1D\"^^xsd:dayTimeDuration / \"PT6H\"^^xsd:dayTimeDuration", "4"},
        Case{"\"P1Y\"^^xsd:yearMonthDuration = \"P12M\"^^xsd:yearMonthDuration", "true"}));

TEST(Functions, UuidsAreRandomAndOfVersionFour) {
  Table table;
  const std::regex uuid("\"[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}\"");
  const Rows rows = table.rows("SELECT (STRUUID() AS ?a) (STRUUID() AS ?b) (STR(UUID()) AS ?c) {}");
  EXPECT_TRUE(std::regex_match(rows[0][0], uuid)) << rows[0][0];
  EXPECT_NE(rows[0][0], rows[0][1]);
  EXPECT_TRUE(rows[0][2].starts_with("\"urn:uuid:")) << rows[0][2];
  EXPECT_TRUE(table.ask("ASK { BIND(RAND() AS ?r) FILTER(?r >= 0 && ?r < 1) }"));
}

TEST(Functions, ABnodeLabelIsOneNodeInOneSolution) {
  Table table(":a :p 1 , 2 .");
  EXPECT_EQ(
      table.rows("SELECT DISTINCT (BNODE(\"x\") AS ?a) (BNODE(\"x\") AS ?b) { :a :p ?o }").size(),
      2u);
  EXPECT_TRUE(
      table.ask("ASK { :a :p ?o BIND(BNODE(\"x\") AS ?a) BIND(BNODE(\"x\") AS ?b) "
                "FILTER(?a = ?b) }"));
}

}  // namespace
}  // namespace sinew::rdf::sparql
