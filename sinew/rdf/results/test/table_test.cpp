#include "sinew/rdf/results/table.h"

#include <gtest/gtest.h>

namespace sinew::rdf {
namespace {

using graph::Id;

TEST(Table, AlignsColumnsAndShortensIris) {
  graph::Terms terms;
  const Prefixes prefixes{{"arm", "http://x/arm/"}};
  const ResultSet results = {{"joint", "position_rad"},
                             {{terms.iri("http://x/arm/joint1"), terms.real(0.5)},
                              {terms.iri("http://y/"), Id{}},
                              {terms.fresh_blank(), terms.literal("zwölf\n\x1B", {}, "de")}},
                             {}};
  EXPECT_EQ(write_table(results, terms, prefixes),
            "?joint       ?position_rad\n"
            "-----------  ------------------\n"
            "arm:joint1   0.5\n"
            "<http://y/>\n"
            "_:b0         \"zwölf\\n\\u001B\"@de\n"
            "(3 rows)\n");
}

TEST(Table, ShowsEvenAnIriThatNoFileCouldHold) {
  graph::Terms terms;
  const ResultSet results = {{"x"}, {{terms.iri("no scheme")}}, {}};
  EXPECT_NE(write_table(results, terms, {}).find("no"), std::string::npos);
}

TEST(Table, SaysYesOrNo) {
  graph::Terms terms;
  EXPECT_EQ(write_table({{}, {}, true}, terms, {}), "yes\n");
  EXPECT_EQ(write_table({{}, {}, false}, terms, {}), "no\n");
}

}  // namespace
}  // namespace sinew::rdf
