#include "sinew/rdf/shacl/literals.h"

#include <gtest/gtest.h>

#include <string>

namespace sinew::rdf::shacl {
namespace {

std::string xsd(std::string_view name) {
  return "http://www.w3.org/2001/XMLSchema#" + std::string(name);
}

struct Lexical {
  const char* datatype;
  const char* text;
  bool well_formed;
};

TEST(Literals, KnowTheLexicalFormsOfXmlSchema) {
  const Lexical cases[] = {
      {"integer", "12", true},
      {"integer", "1.0", false},
      {"byte", "300", false},
      {"boolean", "1", true},
      {"boolean", "yes", false},
      {"dateTime", "2024-02-29T24:00:00Z", true},
      {"dateTime", "2023-02-29T00:00:00Z", false},
      {"dateTime", "2024-01-01T24:00:01", false},
      {"dateTime", "2024-01-01T00:00:00.125+14:00", true},
      {"dateTime", "2024-01-01T00:00:00+14:01", false},
      {"dateTime", "2024-01-01", false},
      {"dateTime", "-0044-03-15T12:00:00", true},
      {"dateTime", "02024-01-01T00:00:00", false},
      {"dateTimeStamp", "2024-01-01T00:00:00", false},
      {"date", "2024-13-01", false},
      {"time", "23:59:59.9", true},
      {"gYear", "2024", true},
      {"gYearMonth", "2024-01Z", true},
      {"gMonth", "--12", true},
      {"gMonthDay", "--02-30", false},
      {"gDay", "---31", true},
      {"duration", "P1Y2M3DT4H5M6.7S", true},
      {"duration", "-PT0S", true},
      {"duration", "P", false},
      {"duration", "P1YT", false},
      {"duration", "P1S", false},
      {"duration", "P1M1Y", false},
      {"yearMonthDuration", "P1D", false},
      {"dayTimeDuration", "P1DT1H", true},
      {"dayTimeDuration", "P1Y", false},
      {"hexBinary", "0aF0", true},
      {"hexBinary", "0aF", false},
      {"base64Binary", "aGk=", true},
      {"base64Binary", "aGl=", false},
      {"base64Binary", "aGk", false},
      {"language", "de-AT", true},
      {"language", "d1", false},
      {"token", "a b", true},
      {"token", "a  b", false},
      {"NCName", "a:b", false},
      {"NMTOKEN", "1a", true},
      {"string", "anything", true},
  };
  for (const Lexical& c : cases) {
    EXPECT_EQ(is_well_formed(c.text, xsd(c.datatype)), c.well_formed)
        << c.datatype << " " << c.text;
  }
  EXPECT_TRUE(is_well_formed("anything", "http://example.org/own"));
}

struct Comparison {
  const char *a, *a_type, *b, *b_type;
  std::partial_ordering order;
};

TEST(Literals, CompareAsInSparql) {
  constexpr auto less = std::partial_ordering::less, equal = std::partial_ordering::equivalent,
                 greater = std::partial_ordering::greater, none = std::partial_ordering::unordered;
  const Comparison cases[] = {
      {"1", "integer", "1.5", "double", less},
      {"10", "integer", "9", "integer", greater},
      {"-10", "integer", "-9", "integer", less},
      {"1.10", "decimal", "1.1", "decimal", equal},
      {"-0", "integer", "0.0", "decimal", equal},
      {"100000000000000000000001", "integer", "100000000000000000000000", "integer", greater},
      {"NaN", "double", "1", "double", none},
      {"a", "string", "b", "string", less},
      {"a", "string", "1", "integer", none},
      {"false", "boolean", "1", "boolean", less},
      {"2024-01-01T00:00:00Z", "dateTime", "2024-01-01T01:00:00+01:00", "dateTime", equal},
      {"2024-01-01T00:00:00", "dateTime", "2024-01-01T01:00:00Z", "dateTime", none},
      {"2024-01-01T00:00:00", "dateTime", "2024-01-02T00:00:00Z", "dateTime", less},
      {"2024-01-01T00:00:00.10Z", "dateTime", "2024-01-01T00:00:00.1Z", "dateTime", equal},
      {"2024-01-02", "date", "2024-01-01", "date", greater},
      {"12:00:00", "time", "11:59:59", "time", greater},
  };
  graph::Terms terms;
  sparql::values::TermSpace space;
  space.begin(terms, 0);
  for (const Comparison& c : cases) {
    const Id a = terms.literal(c.a, xsd(c.a_type)), b = terms.literal(c.b, xsd(c.b_type));
    EXPECT_TRUE(compare_values(a, b, space) == c.order) << c.a << " and " << c.b;
  }
  EXPECT_TRUE(compare_values(terms.iri("a"), terms.iri("b"), space) == none);
}

}  // namespace
}  // namespace sinew::rdf::shacl
