// SPARQL 1.1 Update.
#include <gtest/gtest.h>

#include "sinew/base/error.h"
#include "sinew/rdf/sparql/test/table.h"

namespace sinew::rdf::sparql {
namespace {

struct Case {
  const char* name;
  const char* before;
  const char* update;
  Rows after;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class Update : public testing::TestWithParam<Case> {};

TEST_P(Update, Leaves) {
  Table table(GetParam().before);
  table.update(GetParam().update);
  EXPECT_EQ(table.quads(), GetParam().after);
}

INSTANTIATE_TEST_SUITE_P(
    Data, Update,
    testing::Values(Case{"InsertData",
                         "",
                         "INSERT DATA { :a :p 1 . GRAPH :g { :a :p 2 } }",
                         {{":a", ":p", "1", "-"}, {":a", ":p", "2", ":g"}}},
                    Case{"DeleteData",
                         ":a :p 1 , 2 .",
                         "DELETE DATA { :a :p 1 . :b :p 1 }",
                         {{":a", ":p", "2", "-"}}},
                    Case{"BlankNodesAreNew",
                         ":a :p _:x .",
                         "INSERT DATA { :a :p _:x , _:x }",
                         {{":a", ":p", "_", "-"}, {":a", ":p", "_", "-"}}},
                    Case{"OneAfterTheOther",
                         "",
                         "INSERT DATA { :a :p 1 } ; INSERT { ?x :q ?y } WHERE { ?x :p ?y } ;",
                         {{":a", ":p", "1", "-"}, {":a", ":q", "1", "-"}}}),
    [](const auto& info) { return std::string(info.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Modify, Update,
    testing::Values(
        Case{"DeleteAndInsert",
             ":a :p 1 . :b :p 2 .",
             "DELETE { ?x :p ?n } INSERT { ?x :p ?m } WHERE { ?x :p ?n BIND(?n + 10 AS ?m) }",
             {{":a", ":p", "11", "-"}, {":b", ":p", "12", "-"}}},
        // The whole of WHERE is found before the first change, so values can be swapped.
        Case{"Swap",
             ":a :p 1 . :b :p 2 .",
             "DELETE { :a :p ?x . :b :p ?y } INSERT { :a :p ?y . :b :p ?x } WHERE { :a :p ?x . :b "
             ":p ?y }",
             {{":a", ":p", "2", "-"}, {":b", ":p", "1", "-"}}},
        Case{"DeleteWhere",
             ":a :p 1 ; :q 2 .",
             "DELETE WHERE { ?x :p ?y }",
             {{":a", ":q", "2", "-"}}},
        Case{"With",
             ":g { :a :p 1 } :h { :a :p 1 }",
             "WITH :g DELETE { ?x :p ?y } INSERT { ?x :q ?y } WHERE { ?x :p ?y }",
             {{":a", ":p", "1", ":h"}, {":a", ":q", "1", ":g"}}},
        Case{"Using",
             ":g { :a :p 1 } :h { :a :p 2 }",
             "INSERT { ?x :q ?y } USING :h WHERE { ?x :p ?y }",
             {{":a", ":p", "1", ":g"}, {":a", ":p", "2", ":h"}, {":a", ":q", "2", "-"}}},
        Case{"GraphsAsVariables",
             ":g { :a :p 1 } :h { :b :p 1 }",
             "DELETE { GRAPH ?g { ?x :p ?y } } WHERE { GRAPH ?g { ?x :p ?y FILTER(?x = :b) } }",
             {{":a", ":p", "1", ":g"}}},
        Case{"UnboundVariablesMakeNoTriple",
             ":a :p 1 .",
             "INSERT { ?x :q ?z . ?x :r ?y } WHERE { ?x :p ?y OPTIONAL { ?x :none ?z } }",
             {{":a", ":p", "1", "-"}, {":a", ":r", "1", "-"}}}),
    [](const auto& info) { return std::string(info.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Graphs, Update,
    testing::Values(
        Case{"ClearGraph",
             ":a :p 1 . :g { :a :p 2 } :h { :a :p 3 }",
             "CLEAR GRAPH :g",
             {{":a", ":p", "1", "-"}, {":a", ":p", "3", ":h"}}},
        Case{
            "ClearDefault", ":a :p 1 . :g { :a :p 2 }", "CLEAR DEFAULT", {{":a", ":p", "2", ":g"}}},
        Case{"DropNamed",
             ":a :p 1 . :g { :a :p 2 } :h { :a :p 3 }",
             "DROP NAMED",
             {{":a", ":p", "1", "-"}}},
        Case{"DropAll", ":a :p 1 . :g { :a :p 2 }", "DROP ALL", {}},
        Case{"Copy",
             ":a :p 1 . :g { :a :p 2 }",
             "COPY DEFAULT TO :g",
             {{":a", ":p", "1", "-"}, {":a", ":p", "1", ":g"}}},
        Case{"Move",
             ":g { :a :p 2 } :h { :a :p 3 }",
             "MOVE :g TO GRAPH :h",
             {{":a", ":p", "2", ":h"}}},
        Case{"Add",
             ":g { :a :p 2 } :h { :a :p 3 }",
             "ADD :g TO :h",
             {{":a", ":p", "2", ":g"}, {":a", ":p", "2", ":h"}, {":a", ":p", "3", ":h"}}},
        Case{"ToItself", ":g { :a :p 2 }", "MOVE :g TO :g", {{":a", ":p", "2", ":g"}}},
        Case{"SilentOnWhatIsMissing",
             ":a :p 1 .",
             "DROP SILENT GRAPH :g ; COPY SILENT :g TO DEFAULT",
             {{":a", ":p", "1", "-"}}}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(Update, CountsWhatChanged) {
  Table table(":a :p 1 .");
  const UpdateCounts counts =
      table.update("INSERT DATA { :a :p 1 , 2 , 3 } ; DELETE DATA { :a :p 1 , 9 }");
  EXPECT_EQ(counts.added, 2u);
  EXPECT_EQ(counts.removed, 1u);
}

TEST(Update, IsAllOrNothing) {
  Table table(":a :p 1 .");
  const std::string message = table.update_refusal("INSERT DATA { :b :p 2 } ; DROP GRAPH :nowhere");
  EXPECT_NE(message.find("there is no graph <http://e/nowhere>"), std::string::npos) << message;
  EXPECT_EQ(table.quads(), (Rows{{":a", ":p", "1", "-"}}));
}

TEST(Update, KeepsWhatTheTransactionDidBefore) {
  Table table;
  graph::Transaction transaction = table.store.begin();
  transaction.add({table.id(":a"), table.id(":p"), table.id(":b")});
  EXPECT_THROW(update(transaction, table.store.terms(),
                      "INSERT DATA { <http://e/x> <http://e/p> 1 } ; LOAD <http://e/f>"),
               Error);
  transaction.commit();
  EXPECT_EQ(table.quads(), (Rows{{":a", ":p", ":b", "-"}}));
}

TEST(Update, CreateMakesAnEmptyGraph) {
  Table table;
  table.update("CREATE GRAPH :g");
  EXPECT_EQ(table.rows("SELECT ?g { GRAPH ?g {} }"), (Rows{{":g"}}));
  EXPECT_NE(table.update_refusal("CREATE GRAPH :g").find("exists already"), std::string::npos);
  table.update("CREATE SILENT GRAPH :g ; DROP GRAPH :g");
  EXPECT_EQ(table.rows("SELECT ?g { GRAPH ?g {} }"), (Rows{}));
}

TEST(Update, LoadsOnlyThroughTheLoader) {
  Table table;
  EXPECT_NE(table.update_refusal("LOAD :file").find("nothing is fetched"), std::string::npos);
  table.update("LOAD SILENT :file");
  UpdateOptions options;
  options.load = [&](std::string_view iri, const std::function<void(const graph::Quad&)>& add) {
    add({table.store.terms().iri(iri), table.id(":p"), table.id(":b")});
  };
  table.update("LOAD :file ; LOAD :other INTO GRAPH :g", options);
  EXPECT_EQ(table.quads(), (Rows{{":file", ":p", ":b", "-"}, {":other", ":p", ":b", ":g"}}));
}

}  // namespace
}  // namespace sinew::rdf::sparql
