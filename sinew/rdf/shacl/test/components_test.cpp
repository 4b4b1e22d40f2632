// Each constraint component of SHACL Core: which values it lets pass. The suites of the W3C (see
// rdf/test/w3c) ask more; this is what a reader wants to know first.
#include "fixture.h"

namespace sinew::rdf::shacl {
namespace {

struct Case {
  const char* name;
  const char* constraint;  // of a shape with sh:path ex:p
  const char* data;        // values of ex:p of ex:n, one of which fails, and more triples
  const char* failing;     // the value that fails; "-" for a result without value; "" for none
};

// `data` after the first '|' are further triples.
const Case kCases[] = {
    {"ClassIsInherited", "sh:class ex:Body",
     "ex:a | ex:a a ex:Link . ex:Link rdfs:subClassOf ex:Body", ""},
    {"ClassIsRequired", "sh:class ex:Body", "ex:a, ex:b | ex:a a ex:Body", "b"},
    {"ClassRefusesLiterals", "sh:class ex:Body", "'a'", "a"},
    {"Datatype", "sh:datatype xsd:integer", "1, 1.5", "1.5"},
    {"DatatypeRefusesIllFormed", "sh:datatype xsd:date", "'2024-02-30'^^xsd:date", "2024-02-30"},
    {"NodeKind", "sh:nodeKind sh:BlankNodeOrIRI", "ex:a, [], 'a'", "a"},
    {"MinCount", "sh:minCount 2", "1", "-"},
    {"MinCountIsMet", "sh:minCount 2", "1, 2", ""},
    {"MaxCount", "sh:maxCount 1", "1, 2", "-"},
    {"MinExclusive", "sh:minExclusive 0", "1, 0", "0"},
    {"MinInclusive", "sh:minInclusive 0", "0, -0.1", "-0.1"},
    {"MaxExclusive", "sh:maxExclusive 1", "0.5, 1.0", "1.0"},
    {"MaxInclusive", "sh:maxInclusive 1", "1.0e0, 2", "2"},
    {"RangeRefusesWhatCannotBeCompared", "sh:minInclusive 1", "'2'", "2"},
    {"RangeOfLargeIntegersIsExact", "sh:minExclusive 9007199254740993",
     "9007199254740994, 9007199254740993", "9007199254740993"},
    {"MinLengthCountsCharacters", "sh:minLength 4", "'äöüß', 'abc'", "abc"},
    {"MaxLength", "sh:maxLength 3", "'abc', 'abcd'", "abcd"},
    {"LengthsRefuseBlankNodes", "sh:maxLength 100 ; sh:nodeKind sh:IRI", "ex:a", ""},
    {"Pattern", "sh:pattern '^j[0-9]+$'", "'j12', 'x1'", "x1"},
    {"PatternWithFlags", "sh:pattern '^J' ; sh:flags 'i'", "'joint'", ""},
    {"PatternMatchesIris", "sh:pattern 'example'", "ex:a", ""},
    {"LanguageIn", "sh:languageIn ('en' 'de')", "'a'@en-GB, 'b'@fr", "b"},
    {"LanguageInNeedsALanguage", "sh:languageIn ('en')", "'a'", "a"},
    {"UniqueLang", "sh:uniqueLang true", "'a'@en, 'b'@EN", "-"},
    {"Equals", "sh:equals ex:q", "1, 2 | ex:n ex:q 1", "2"},
    {"EqualsLooksBothWays", "sh:equals ex:q", "1 | ex:n ex:q 1, 3", "3"},
    {"Disjoint", "sh:disjoint ex:q", "1, 2 | ex:n ex:q 2, 3", "2"},
    {"LessThan", "sh:lessThan ex:q", "1, 3 | ex:n ex:q 3", "3"},
    {"LessThanOrEquals", "sh:lessThanOrEquals ex:q", "1, 3 | ex:n ex:q 3", ""},
    {"LessThanOfDates", "sh:lessThan ex:q",
     "'2024-01-01T00:00:00+01:00'^^xsd:dateTime | ex:n ex:q '2023-12-31T23:30:00Z'^^xsd:dateTime",
     ""},
    {"Not", "sh:not [ sh:datatype xsd:string ]", "1, 'a'", "a"},
    {"And", "sh:and ([ sh:minInclusive 1 ] [ sh:maxInclusive 3 ])", "2, 4", "4"},
    {"Or", "sh:or ([ sh:datatype xsd:string ] [ sh:datatype xsd:integer ])", "1, 'a', 1.5", "1.5"},
    {"Xone", "sh:xone ([ sh:minInclusive 1 ] [ sh:maxInclusive 3 ])", "0, 4, 2", "2"},
    {"Node", "sh:node [ sh:property [ sh:path ex:q ; sh:minCount 1 ] ]", "ex:a, ex:b | ex:a ex:q 1",
     "b"},
    {"QualifiedMin", "sh:qualifiedValueShape [ sh:datatype xsd:integer ] ; sh:qualifiedMinCount 2",
     "1, 'a'", "-"},
    {"QualifiedMax", "sh:qualifiedValueShape [ sh:datatype xsd:integer ] ; sh:qualifiedMaxCount 1",
     "1, 'a'", ""},
    {"HasValue", "sh:hasValue ex:a", "ex:a, ex:b", ""},
    {"HasValueIsMissing", "sh:hasValue ex:a", "ex:b", "-"},
    {"In", "sh:in (ex:a 1 'x'@en)", "ex:a, 1, 'x'@en, 'x'", "x"},
    {"InOfNothing", "sh:in ()", "ex:a", "a"},
};

class Component : public Shacl, public ::testing::WithParamInterface<Case> {};

TEST_P(Component, LetsPassWhatItShould) {
  const Case& c = GetParam();
  const std::string data(c.data);
  const std::size_t bar = data.find('|');
  const std::string more = bar == std::string::npos ? "" : data.substr(bar + 1) + " .";
  const Lines found =
      results("ex:S a sh:NodeShape ; sh:targetNode ex:n ; sh:property [ sh:path ex:p ; " +
                  std::string(c.constraint) + " ] .",
              "ex:n ex:p " + data.substr(0, bar) + " . " + more);
  const std::string failing(c.failing);
  EXPECT_EQ(found, failing.empty() ? Lines{} : Lines{"n " + failing});
}

INSTANTIATE_TEST_SUITE_P(Core, Component, ::testing::ValuesIn(kCases),
                         [](const auto& info) { return info.param.name; });

TEST_F(Shacl, ClosedShapesAllowTheirPropertiesAndTheIgnoredOnes) {
  const ValidationReport report = validate_text(
      R"(ex:S a sh:NodeShape ; sh:targetNode ex:n ; sh:closed true ; sh:ignoredProperties (rdf:type) ;
         sh:property [ sh:path ex:p ] .)",
      "ex:n a ex:Body ; ex:p 1 ; ex:q 2 .");
  EXPECT_EQ(results(report), (Lines{"n 2"}));
  ASSERT_EQ(report.results.size(), 1u);
  EXPECT_EQ(*report.results[0].path, Path::of(iri("q")));
}

TEST_F(Shacl, QualifiedShapesMayExcludeTheirSiblings) {
  // A hand needs a thumb and four fingers; a value that is both counts for neither.
  const std::string_view shapes = R"(
ex:Hand a sh:NodeShape ; sh:targetClass ex:Hand ; sh:property ex:thumbs, ex:fingers .
ex:thumbs sh:path ex:digit ; sh:qualifiedValueShape [ sh:class ex:Thumb ] ;
  sh:qualifiedValueShapesDisjoint true ; sh:qualifiedMinCount 1 .
ex:fingers sh:path ex:digit ; sh:qualifiedValueShape [ sh:class ex:Finger ] ;
  sh:qualifiedValueShapesDisjoint true ; sh:qualifiedMinCount 1 .)";
  EXPECT_EQ(results(shapes, R"(ex:h a ex:Hand ; ex:digit ex:a, ex:b .
                               ex:a a ex:Thumb, ex:Finger . ex:b a ex:Finger .)"),
            (Lines{"h -"}));
}

// ---- lists, as models have them ----

// Published shapes count the values of a property; where JSON-LD makes a list of them, there is one
// value, the list's head. The path to the members is this.
TEST_F(Shacl, ReachesTheMembersOfAList) {
  const std::string_view shapes = R"(ex:S a sh:NodeShape ; sh:targetClass ex:Position ; sh:property
  [ sh:path ( ex:coordinates [ sh:zeroOrMorePath rdf:rest ] rdf:first ) ;
    sh:minCount 3 ; sh:maxCount 3 ; sh:datatype xsd:double ] .)";
  EXPECT_EQ(results(shapes, R"(
ex:good a ex:Position ; ex:coordinates (1e0 2e0 3e0) .
ex:short a ex:Position ; ex:coordinates (1e0 2e0) .
ex:wrong a ex:Position ; ex:coordinates (1e0 2e0 3) .)"),
            (Lines{"short -", "wrong 3"}));
}

// Equal members of a list are one node, so members cannot be counted with their repetitions.
TEST_F(Shacl, CountsEqualMembersOfAListOnce) {
  EXPECT_EQ(results(R"(ex:S a sh:NodeShape ; sh:targetNode ex:n ; sh:property
  [ sh:path ( ex:coordinates [ sh:zeroOrMorePath rdf:rest ] rdf:first ) ; sh:minCount 3 ] .)",
                    "ex:n ex:coordinates (0e0 0e0 1e0) ."),
            (Lines{"n -"}));
  // The cells can: as many as the list has members, and the empty list at its end.
  EXPECT_EQ(results(R"(ex:S2 a sh:NodeShape ; sh:targetNode ex:m ; sh:property
  [ sh:path ( ex:coordinates [ sh:zeroOrMorePath rdf:rest ] ) ; sh:minCount 4 ; sh:maxCount 4 ] .)",
                    "ex:m ex:coordinates (0e0 0e0 1e0) ."),
            (Lines{"n -"}));
}

}  // namespace
}  // namespace sinew::rdf::shacl
