// The three forms of a report.
#include "fixture.h"
#include "sinew/rdf/turtle/writer.h"

namespace sinew::rdf::shacl {
namespace {

class Report : public Shacl {
 protected:
  Report()
      : report(
            validate_text(R"(ex:S a sh:NodeShape ; sh:targetNode ex:joint ; sh:property ex:Limit .
ex:Limit sh:path ex:limit ; sh:minInclusive 0 ; sh:message "limits are positive"@en .
ex:Any a sh:NodeShape ; sh:targetNode ex:joint ; sh:property ex:Name .
ex:Name sh:path [ sh:alternativePath (ex:name ex:label) ] ; sh:minCount 1 ; sh:severity sh:Warning .)",
                          "ex:joint a ex:Joint ;\n  ex:limit -3 .")) {}
  ValidationReport report;
};

TEST_F(Report, AsTextHasFileAndLineOfThePropertyThatIsWrong) {
  EXPECT_EQ(to_text(report, store.terms(), &places),
            "data.ttl:2: http://example.org/joint: http://example.org/limit: limits are positive; "
            "the value is \"-3\"^^<http://www.w3.org/2001/XMLSchema#integer>: it must be at least "
            "\"0\"^^<http://www.w3.org/2001/XMLSchema#integer> (shape http://example.org/Limit)\n"
            "data.ttl:1: http://example.org/joint: warning: "
            "(<http://example.org/name>|<http://example.org/label>): there are 0 values; "
            "at least 1 are needed (shape http://example.org/Name)\n");
  EXPECT_EQ(to_text({}, store.terms()), "conforms\n");
}

TEST_F(Report, AsProblemsKeepsTheSeverity) {
  const auto problems = to_problems(report, store.terms(), &places);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].severity, Severity::kError);
  EXPECT_EQ(problems[0].place.line, 2u);
  EXPECT_EQ(problems[0].code, "http://www.w3.org/ns/shacl#MinInclusiveConstraintComponent");
  EXPECT_EQ(problems[1].severity, Severity::kWarning);
}

TEST_F(Report, AsGraphHasTheTermsOfTheStandard) {
  const auto quads = to_graph(report, store, iri("report"));
  const Prefixes prefixes{{"sh", "http://www.w3.org/ns/shacl#"}, {"ex", "http://example.org/"}};
  std::vector<graph::Quad> triples = quads;
  for (graph::Quad& quad : triples) quad.graph = {};
  const std::string text = write_rdf(triples, Syntax::kTurtle, store.terms(), {prefixes, true});
  for (const char* part : {"a sh:ValidationReport", "sh:conforms false", "sh:focusNode ex:joint",
                           "sh:resultPath ex:limit", "sh:value -3",
                           "sh:resultSeverity sh:Violation", "sh:sourceShape ex:Limit",
                           "sh:sourceConstraintComponent sh:MinInclusiveConstraintComponent",
                           "sh:resultMessage \"limits are positive\"@en", "sh:alternativePath",
                           "sh:resultSeverity sh:Warning"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
  EXPECT_EQ(quads[0].graph, iri("report"));
}

TEST_F(Report, AsJsonHasEverythingToo) {
  const std::string text = to_json(report, store.terms(), &places);
  for (const char* part :
       {"\"conforms\": false", "\"value\": \"http://example.org/joint\"",
        "\"path\": \"<http://example.org/limit>\"", "\"text\": \"limits are positive\"",
        "\"language\": \"en\"", "\"file\": \"data.ttl\"", "\"line\": 2",
        "\"severity\": \"http://www.w3.org/ns/shacl#Warning\"",
        "\"datatype\": \"http://www.w3.org/2001/XMLSchema#integer\""}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

}  // namespace
}  // namespace sinew::rdf::shacl
