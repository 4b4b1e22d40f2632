// Targets, severities, messages; what makes a shape ill-formed; recursion and limits.
#include "fixture.h"

namespace sinew::rdf::shacl {
namespace {

TEST_F(Shacl, FindsFocusNodesByEveryKindOfTarget) {
  const std::string shapes = R"(
ex:A a sh:NodeShape ; sh:targetNode ex:absent, 'literal' ; sh:not [] .
ex:B a sh:NodeShape ; sh:targetClass ex:Joint ; sh:not [] .
ex:C a sh:NodeShape ; sh:targetSubjectsOf ex:of ; sh:not [] .
ex:D a sh:NodeShape ; sh:targetObjectsOf ex:of ; sh:not [] .
ex:E a sh:NodeShape, rdfs:Class ; sh:not [] .)";
  const auto report = validate_text(shapes, R"(
ex:Revolute rdfs:subClassOf ex:Joint . ex:j1 a ex:Revolute, ex:Joint . ex:x ex:of ex:y . ex:e a ex:E .)");
  Lines found = results(report);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (Lines{"absent absent", "e e", "j1 j1", "literal literal", "x x", "y y"}));
}

TEST_F(Shacl, GivesEachResultItsSeverityAndMessages) {
  const auto report = validate_text(R"(
ex:S a sh:NodeShape ; sh:targetNode ex:n ; sh:property
  [ sh:path ex:p ; sh:minCount 1 ; sh:severity sh:Warning ; sh:message "fehlt"@de, "missing"@en ] .)",
                                    "ex:n ex:q 1 .");
  ASSERT_EQ(report.results.size(), 1u);
  EXPECT_EQ(report.results[0].severity, store.terms().iri("http://www.w3.org/ns/shacl#Warning"));
  ASSERT_EQ(report.results[0].messages.size(), 2u);
  EXPECT_EQ(report.results[0].messages[0].text, "fehlt");
  EXPECT_EQ(report.results[0].messages[0].language, "de");
  EXPECT_FALSE(report.conforms());
}

TEST_F(Shacl, LeavesDeactivatedShapesAlone) {
  EXPECT_EQ(results(R"(
ex:S a sh:NodeShape ; sh:targetNode ex:n ; sh:deactivated true ; sh:not [] .
ex:T a sh:NodeShape ; sh:targetNode ex:n ; sh:property [ sh:path ex:p ; sh:minCount 1 ; sh:deactivated true ] .)",
                    ""),
            Lines{});
}

TEST_F(Shacl, ExplainsWhyANodeDoesNotConformToAnotherShape) {
  const auto report = validate_text(R"(
ex:S a sh:NodeShape ; sh:targetNode ex:n ; sh:property [ sh:path ex:p ; sh:node ex:T ] .
ex:T a sh:NodeShape ; sh:property [ sh:path ex:q ; sh:minCount 1 ] .)",
                                    "ex:n ex:p ex:m .");
  ASSERT_EQ(report.results.size(), 1u);
  EXPECT_EQ(report.results[0].value, iri("m"));
  ASSERT_EQ(report.results[0].details.size(), 1u);
  EXPECT_EQ(report.results[0].details[0].focus_node, iri("m"));
}

TEST_F(Shacl, ValidatesOneNodeAgainstOneShape) {
  const Shapes shapes = parse("ex:S a sh:NodeShape ; sh:class ex:C .");
  load("ex:good a ex:C .", {}, "data.ttl");
  EXPECT_TRUE(validate_node(shapes, iri("S"), iri("good"), data()).conforms());
  EXPECT_FALSE(validate_node(shapes, iri("S"), iri("bad"), data()).conforms());
  EXPECT_THROW(validate_node(shapes, iri("unknown"), iri("good"), data()), Error);
}

// ---- ill-formed shapes ----

struct IllFormed {
  const char* name;
  const char* shape;
  const char* message;  // a part of it
};

const IllFormed kIllFormed[] = {
    {"PropertyShapeWithoutPath", "a sh:PropertyShape", "without sh:path"},
    {"NodeShapeWithPath", "a sh:NodeShape ; sh:path ex:p", "with sh:path"},
    {"TwoPaths", "a sh:PropertyShape ; sh:path ex:p, ex:q", "has 2 values"},
    {"PathIsLiteral", "a sh:PropertyShape ; sh:path 'p'", "is no path"},
    {"PathOfOne", "a sh:PropertyShape ; sh:path (ex:p)", "list of 1 path"},
    {"PathInItself", "a sh:PropertyShape ; sh:path _:p . _:p sh:inversePath _:p", "nested deeper"},
    {"PropertyOfNoPath", "a sh:NodeShape ; sh:property []", "has no sh:path"},
    {"NodeOfPropertyShape", "a sh:NodeShape ; sh:node [ sh:path ex:p ]", "a property shape"},
    {"MinCountOfNodeShape", "a sh:NodeShape ; sh:minCount 1", "only property shapes"},
    {"QualifiedOfNodeShape", "a sh:NodeShape ; sh:qualifiedValueShape [] ; sh:qualifiedMinCount 1",
     "only property shapes"},
    {"MinCountNoInteger", "a sh:PropertyShape ; sh:path ex:p ; sh:minCount 1.0",
     "non-negative integer"},
    {"MinCountNegative", "a sh:PropertyShape ; sh:path ex:p ; sh:minCount -1",
     "non-negative integer"},
    {"ClassIsLiteral", "a sh:NodeShape ; sh:class 'C'", "must be an IRI"},
    {"TwoDatatypes", "a sh:NodeShape ; sh:datatype xsd:int, xsd:long", "has 2 values"},
    {"NodeKindUnknown", "a sh:NodeShape ; sh:nodeKind sh:Anything", "sh:nodeKind is"},
    {"BoundIsIri", "a sh:NodeShape ; sh:minInclusive ex:a", "must be a literal"},
    {"PatternBroken", "a sh:NodeShape ; sh:pattern '('", "sh:pattern"},
    {"LanguagesNoList", "a sh:NodeShape ; sh:languageIn 'en'", "no well-formed list"},
    {"LanguageNoString", "a sh:NodeShape ; sh:languageIn (1)", "must be a string"},
    {"ListInItself", "a sh:NodeShape ; sh:in _:l . _:l rdf:first 1 ; rdf:rest _:l",
     "no well-formed list"},
    {"AndNoList", "a sh:NodeShape ; sh:and ex:a", "no well-formed list"},
    {"ShapeIsLiteral", "a sh:NodeShape ; sh:not 'x'", "literal is used as a shape"},
    {"ClosedNoBoolean", "a sh:NodeShape ; sh:closed 'yes'", "must be true or false"},
    {"IgnoredNoIri", "a sh:NodeShape ; sh:closed true ; sh:ignoredProperties ('x')",
     "must be an IRI"},
    {"SeverityNoIri", "a sh:NodeShape ; sh:severity 'high'", "must be an IRI"},
    {"MessageNoString", "a sh:NodeShape ; sh:message 1", "must be a string"},
    {"TargetBlank", "a sh:NodeShape ; sh:targetNode []", "is a blank node"},
    {"TargetClassLiteral", "a sh:NodeShape ; sh:targetClass 'C'", "must be an IRI"},
    {"SparqlWithoutSelect", "a sh:NodeShape ; sh:sparql []", "there is no sh:select"},
    {"SparqlBroken", "a sh:NodeShape ; sh:sparql [ sh:select 'SELECT' ]", "the query of sh:select"},
    {"SparqlNoThis", "a sh:NodeShape ; sh:sparql [ sh:select 'SELECT ?x { ?x ?y ?z }' ]",
     "does not return $this"},
    {"SparqlIsAsk", "a sh:NodeShape ; sh:sparql [ sh:select 'ASK {}' ]", "of another form"},
};

class IllFormedShape : public Shacl, public ::testing::WithParamInterface<IllFormed> {};

TEST_P(IllFormedShape, IsAnErrorWithItsPlace) {
  const std::string message = fault("\n\nex:S " + std::string(GetParam().shape) + " .");
  EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
  EXPECT_TRUE(message.starts_with("shapes.ttl:3: ")) << message;
}

INSTANTIATE_TEST_SUITE_P(Shapes, IllFormedShape, ::testing::ValuesIn(kIllFormed),
                         [](const auto& info) { return info.param.name; });

TEST_F(Shacl, ReportsAllIllFormedShapesTogether) {
  const std::string message =
      fault("ex:S a sh:NodeShape ; sh:minCount 1 .\nex:T a sh:NodeShape ; sh:class 'C' .");
  EXPECT_NE(message.find("shapes.ttl:1"), std::string::npos) << message;
  EXPECT_NE(message.find("shapes.ttl:2"), std::string::npos) << message;
}

TEST_F(Shacl, WarnsOfWhatHasAMeaningButHardlyTheOneIntended) {
  const Shapes shapes = parse(R"(
ex:S a sh:PropertyShape ; sh:path ex:p ; sh:qualifiedMinCount 1 ; sh:uniqueLang "1"^^xsd:boolean .)");
  ASSERT_EQ(shapes.warnings.size(), 2u);
  EXPECT_NE(to_string(shapes.warnings[0]).find("only the literal true"), std::string::npos);
  EXPECT_NE(to_string(shapes.warnings[1]).find("without sh:qualifiedValueShape"),
            std::string::npos);
}

// ---- recursion and limits ----

constexpr std::string_view kChain = R"(
ex:Link a sh:NodeShape ; sh:property [ sh:path ex:child ; sh:node ex:Link ] , [ sh:path ex:mass ; sh:minCount 1 ] .
ex:Root a sh:NodeShape ; sh:targetNode ex:base ; sh:node ex:Link .)";

TEST_F(Shacl, FollowsShapesThatReferToThemselvesAlongTheData) {
  const std::string data = "ex:base ex:mass 1 ; ex:child ex:a, ex:b . ex:a ex:mass 1 . ";
  EXPECT_EQ(results(kChain, data), (Lines{"base base"}));
  load("ex:b ex:mass 2 .", {}, "more.ttl");
  EXPECT_TRUE(validate(parse(""), this->data()).conforms());
}

TEST_F(Shacl, FailsWhereAVerdictDependsOnItself) {
  EXPECT_THROW(
      validate_text(kChain,
                    "ex:base ex:mass 1 ; ex:child ex:a . ex:a ex:mass 1 ; ex:child ex:base ."),
      Error);
}

TEST_F(Shacl, FailsWhereShapesLeadTooDeepIntoTheData) {
  std::string text = "ex:base ex:mass 1 ; ex:child ex:l0 . ";
  for (std::size_t i = 0; i < kMaxValidationDepth; ++i) {
    text +=
        "ex:l" + std::to_string(i) + " ex:mass 1 ; ex:child ex:l" + std::to_string(i + 1) + " . ";
  }
  EXPECT_THROW(validate_text(kChain, text), Error);
}

TEST_F(Shacl, RefusesShapesThatAreNestedTooDeeply) {
  std::string text = "ex:s0 a sh:NodeShape ; sh:not ex:s1 . ";
  for (std::size_t i = 1; i <= kMaxShapeDepth; ++i) {
    text += "ex:s" + std::to_string(i) + " sh:not ex:s" + std::to_string(i + 1) + " . ";
  }
  EXPECT_NE(fault(text).find("nested deeper"), std::string::npos);
}

TEST_F(Shacl, RefusesListsThatAreTooLong) {
  std::string text = "ex:S a sh:NodeShape ; sh:in (";
  for (std::size_t i = 0; i <= kMaxListLength; ++i) text += "1 ";
  EXPECT_NE(fault(text + ") .").find("members"), std::string::npos);
}

TEST_F(Shacl, RefusesToMakeMoreResultsThanAllowed) {
  load("ex:a a ex:C . ex:b a ex:C . ex:c a ex:C .", {}, "data.ttl");
  const Shapes shapes = parse("ex:S a sh:NodeShape ; sh:targetClass ex:C ; sh:not [] .");
  EXPECT_EQ(validate(shapes, data(), {.max_results = 3}).results.size(), 3u);
  EXPECT_THROW(validate(shapes, data(), {.max_results = 2}), Error);
}

}  // namespace
}  // namespace sinew::rdf::shacl
