// Insertions that are prepared once: what they give for bound parameters, and what is refused.
#include "sinew/rdf/sparql/prepared_insert.h"

#include <gtest/gtest.h>

#include "sinew/base/error.h"

namespace sinew::rdf::sparql {
namespace {

using graph::Id;

class PreparedInsertion : public testing::Test {
 protected:
  Id iri(const std::string& name) { return store_.terms().iri("http://e/" + name); }
  void add(const std::string& s, const std::string& p, const std::string& o) {
    store_.add({iri(s), iri(p), iri(o), {}});
  }
  std::shared_ptr<const PreparedInsert> prepare(const std::string& text) {
    static constexpr std::string_view kParameters[] = {"node"};
    return prepare_insert(store_, text, kParameters);
  }

  graph::Store store_;
};

TEST_F(PreparedInsertion, GivesTheTriplesOfEachSolutionAndChangesNothing) {
  add("a", "child", "b");
  add("a", "child", "c");
  add("b", "child", "d");
  const auto insert = prepare(
      "INSERT { ?child <http://e/parent> ?node . [] <http://e/of> ?child } "
      "WHERE { ?node <http://e/child> ?child }");
  const std::size_t before = store_.view().size();
  const Id a[] = {iri("a")}, b[] = {iri("b")}, d[] = {iri("d")};
  const auto of_a = insert->triples(store_.view(), a);
  ASSERT_EQ(of_a.size(), 4u);
  EXPECT_EQ(of_a[0].object, iri("a"));
  EXPECT_EQ(of_a[0].predicate, iri("parent"));
  EXPECT_NE(of_a[1].subject, of_a[3].subject);  // a blank node of its own for each solution
  ASSERT_EQ(insert->triples(store_.view(), b).size(), 2u);
  EXPECT_EQ(insert->triples(store_.view(), b)[0].subject, iri("d"));
  EXPECT_TRUE(insert->triples(store_.view(), d).empty());
  EXPECT_EQ(store_.view().size(), before);
}

TEST_F(PreparedInsertion, SeesWhatWasAddedSince) {
  const auto insert = prepare("INSERT { ?node <http://e/p> ?o } WHERE { ?node <http://e/q> ?o }");
  const Id x[] = {iri("x")};
  EXPECT_TRUE(insert->triples(store_.view(), x).empty());
  add("x", "q", "y");
  EXPECT_EQ(insert->triples(store_.view(), x).size(), 1u);
}

TEST_F(PreparedInsertion, RefusesWhatIsNotOneInsertion) {
  for (const std::string text :
       {"DELETE { ?node ?p ?o } INSERT { ?node ?p 1 } WHERE { ?node ?p ?o }",
        "INSERT DATA { <http://e/a> <http://e/b> 1 }", "CLEAR ALL",
        "INSERT { ?node ?p 1 } WHERE { ?node ?p ?o } ; INSERT { ?node ?p 2 } WHERE { ?node ?p ?o }",
        "SELECT * WHERE { ?s ?p ?o }", "INSERT { ?node } WHERE { }"}) {
    EXPECT_THROW(prepare(text), Error) << text;
  }
}

}  // namespace
}  // namespace sinew::rdf::sparql
