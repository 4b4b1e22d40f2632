// SHACL-SPARQL: constraints and components that are queries.
#include "fixture.h"
#include "sinew/rdf/shacl/prebinding.h"

namespace sinew::rdf::shacl {
namespace {

TEST_F(Shacl, ASolutionOfAQueryIsAViolation) {
  const auto report =
      validate_text(R"(
ex:S a sh:NodeShape ; sh:targetClass ex:Joint ; sh:sparql [
  sh:message "{$this} is its own parent: {?value}" ; sh:prefixes ex:prefixes ;
  sh:select "SELECT $this ?value WHERE { $this ex:parent ?value FILTER ($this = ?value) }" ] .
ex:prefixes sh:declare [ sh:prefix "ex" ; sh:namespace "http://example.org/"^^xsd:anyURI ] .)",
                    "ex:a a ex:Joint ; ex:parent ex:a . ex:b a ex:Joint ; ex:parent ex:a .");
  EXPECT_EQ(results(report), (Lines{"a a"}));
  ASSERT_EQ(report.results.size(), 1u);
  EXPECT_EQ(report.results[0].messages[0].text,
            "http://example.org/a is its own parent: http://example.org/a");
  EXPECT_TRUE(report.results[0].source_constraint);
}

TEST_F(Shacl, PathStandsForThePathOfThePropertyShape) {
  EXPECT_EQ(results(R"(
ex:S a sh:NodeShape ; sh:targetNode ex:n ; sh:property [
  sh:path ( ex:p [ sh:inversePath ex:q ] ) ; sh:sparql [
  sh:select "SELECT $this ?value { $this $PATH ?value FILTER (?value != $this) # $PATH in a comment\n }" ] ] .)",
                    "ex:n ex:p ex:m . ex:n ex:q ex:m . ex:x ex:q ex:m ."),
            (Lines{"n x"}));
}

// A component with two parameters: its ASK holds for values that conform.
constexpr std::string_view kBetween = R"(
ex:Between a sh:ConstraintComponent ;
  sh:parameter [ sh:path ex:lowest ] , [ sh:path ex:highest ; sh:optional true ] ;
  sh:validator [ sh:message "{$value} is not between {$lowest} and {$highest}" ; sh:ask
    "ASK { FILTER ($value >= $lowest && (!bound($highest) || $value <= $highest)) }" ] .)";

TEST_F(Shacl, ShapesGraphsMayDefineComponents) {
  const auto report = validate_text(std::string(kBetween) + R"(
ex:S a sh:PropertyShape ; sh:targetNode ex:n ; sh:path ex:p ; ex:lowest 1 ; ex:highest 3 .
ex:T a sh:PropertyShape ; sh:targetNode ex:n ; sh:path ex:q ; ex:lowest 1 .)",
                                    "ex:n ex:p 1, 4 ; ex:q 0, 7 .");
  EXPECT_EQ(results(report), (Lines{"n 4", "n 0"}));
  EXPECT_EQ(report.results[0].messages[0].text, "4 is not between 1 and 3");
  EXPECT_EQ(report.results[0].component_iri, iri("Between"));
  EXPECT_EQ(report.results[1].messages[0].text, "0 is not between 1 and {$highest}");
}

TEST_F(Shacl, AComponentWithoutAValidatorForTheShapeIsSaidToBeIgnored) {
  const Shapes shapes = parse(R"(
ex:C a sh:ConstraintComponent ; sh:parameter [ sh:path ex:c ] ;
  sh:propertyValidator [ sh:select "SELECT $this { $this $PATH $c }" ] .
ex:S a sh:NodeShape ; ex:c 1 .)");
  ASSERT_EQ(shapes.warnings.size(), 1u);
  EXPECT_NE(shapes.warnings[0].what.find("no validator"), std::string::npos);
}

TEST_F(Shacl, AQueryMayReportAFailure) {
  EXPECT_THROW(validate_text(R"(ex:S a sh:NodeShape ; sh:targetNode ex:n ; sh:sparql [
    sh:select "SELECT $this (true AS ?failure) { $this ?p ?o }" ] .)",
                             "ex:n ex:p 1 ."),
               Error);
}

TEST_F(Shacl, ANamedGraphAloneCannotBeAskedInSparql) {
  const Shapes shapes = parse(R"(ex:S a sh:NodeShape ; sh:targetNode ex:n ; sh:sparql [
    sh:select "SELECT $this { $this ?p ?o }" ] .)");
  EXPECT_THROW(validate(shapes, GraphReader(store.view(), iri("other"))), Error);
}

TEST_F(Shacl, PrefixesMayNotMeanTwoThings) {
  EXPECT_NE(
      fault(
          R"(ex:S a sh:NodeShape ; sh:sparql [ sh:prefixes ex:a, ex:b ; sh:select "SELECT $this {}" ] .
ex:a sh:declare [ sh:prefix "p" ; sh:namespace "http://a/" ] .
ex:b sh:declare [ sh:prefix "p" ; sh:namespace "http://b/" ] .)")
          .find("means both"),
      std::string::npos);
}

// ---- pre-binding ----

struct Forbidden {
  const char* name;
  const char* query;
  const char* why;
};

const Forbidden kForbidden[] = {
    {"Minus", "SELECT $this { $this ?p ?o MINUS { ?this ?q 1 } }", "MINUS"},
    {"Values", "SELECT $this { VALUES ?x { 1 } }", "VALUES"},
    {"ValuesBehind", "SELECT $this { $this ?p ?x } VALUES ?x { 1 }", "VALUES"},
    {"Service", "SELECT $this { SERVICE <http://x/> { $this ?p ?o } }", "SERVICE"},
    {"Bind", "SELECT $this { BIND (1 AS $this) }", "new value"},
    {"BindInExists", "SELECT $this { FILTER EXISTS { BIND (1 AS ?this) } }", "new value"},
    {"SubSelect", "SELECT $this { { SELECT ?x { ?x ?p ?o } } }", "sub-select"},
    {"PathAsSubject", "SELECT $this { $PATH ?p $this }", "PATH"},
};

class ForbiddenQuery : public Shacl, public ::testing::WithParamInterface<Forbidden> {};

TEST_P(ForbiddenQuery, MakesTheShapeIllFormed) {
  const std::string message = fault("ex:S a sh:NodeShape ; sh:sparql [ sh:select \"" +
                                    std::string(GetParam().query) + "\" ] .");
  EXPECT_NE(message.find(GetParam().why), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(Prebinding, ForbiddenQuery, ::testing::ValuesIn(kForbidden),
                         [](const auto& info) { return info.param.name; });

TEST(WithPath, LeavesStringsIrisAndCommentsAlone) {
  EXPECT_EQ(
      with_path("$PATH ?PATH $PATHS '$PATH' <http://x/$PATH> \"\"\"?PATH\"\"\" # $PATH\n$PATH",
                "P"),
      "P P $PATHS '$PATH' <http://x/$PATH> \"\"\"?PATH\"\"\" # $PATH\nP");
  EXPECT_EQ(with_path("FILTER (?a < ?PATH && ?b > 1)", "P"), "FILTER (?a < P && ?b > 1)");
  EXPECT_EQ(with_path("'it\\'s $PATH' $PATH", "P"), "'it\\'s $PATH' P");
}

}  // namespace
}  // namespace sinew::rdf::shacl
