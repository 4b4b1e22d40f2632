// What `sinew query` writes: rows and triples each in their own formats, and JSON-LD that reads
// back as the same triples.
#include <gtest/gtest.h>

#include "command.h"

namespace sinew::test {
namespace {

constexpr const char* kScene = R"(@prefix : <https://example.org/> .
:table :carries :cup , :plate .
:cup :mass 0.3 ; :made-of ( :clay :glaze ) .
)";

class Answer : public testing::Test {
 protected:
  Answer() { write_file(folder_ / "scene.ttl", kScene); }

  Result query(const std::string& file, const std::string& text,
               std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"query", (folder_ / file).string(), "-e", text};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_sinew(arguments);
  }

  Folder folder_;
};

constexpr const char* kRows = "SELECT ?what WHERE { <https://example.org/table> ?p ?what }";
constexpr const char* kTriples = "CONSTRUCT { ?s ?p ?o } WHERE { ?s ?p ?o }";

TEST_F(Answer, IsATableOrTurtleWhereNoFormatIsAskedFor) {
  EXPECT_NE(query("scene.ttl", kRows).out.find("(2 rows)"), std::string::npos);
  EXPECT_NE(query("scene.ttl", kTriples).out.find("<https://example.org/plate> ."),
            std::string::npos);
}

TEST_F(Answer, InJsonLdReadsBackAsTheSameTriples) {
  const std::string file = (folder_ / "again.jsonld").string();
  const Result written = query("scene.ttl", kTriples, {"--format", "jsonld", "-o", file});
  ASSERT_EQ(written.exit_code, 0) << written.err;
  const std::string before = query("scene.ttl", kTriples).out;
  EXPECT_EQ(query("again.jsonld", kTriples).out, before);
}

TEST_F(Answer, InAFormatOfTheOtherKindIsRefused) {
  const Result rows = query("scene.ttl", kRows, {"--format", "jsonld"});
  EXPECT_EQ(rows.exit_code, 1);
  EXPECT_NE(rows.err.find("--format jsonld: the query gives rows"), std::string::npos) << rows.err;
  EXPECT_NE(rows.err.find("ask for table, json, xml, csv, tsv"), std::string::npos) << rows.err;
  const Result triples = query("scene.ttl", kTriples, {"--format", "csv"});
  EXPECT_EQ(triples.exit_code, 1);
  EXPECT_NE(triples.err.find("ask for turtle, ntriples, jsonld"), std::string::npos) << triples.err;
}

// The project's prefixes come before the text and move no column.
TEST_F(Answer, HasFaultsWhereTheyAre) {
  const Result result = query("scene.ttl", "SELECT ?j WHERE { ?j a kc:Joint . ?j }");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("query:1: column 38"), std::string::npos) << result.err;
  const Result unknown = query("scene.ttl", "SELECT ?j WHERE { ?j a chain:Joint }");
  EXPECT_NE(unknown.err.find("the prefix 'chain:' is not declared"), std::string::npos);
  EXPECT_NE(unknown.err.find(" kc: "), std::string::npos) << "which prefixes there are";
}

}  // namespace
}  // namespace sinew::test
