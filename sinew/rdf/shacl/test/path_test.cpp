#include "sinew/rdf/shacl/path.h"

#include "fixture.h"

namespace sinew::rdf::shacl {
namespace {

// 1 -> 2 -> 3 -> 1 by p, 2 -> 4 by q.
class PathTest : public Shacl {
 protected:
  PathTest() {
    load("ex:n1 ex:p ex:n2 . ex:n2 ex:p ex:n3 . ex:n3 ex:p ex:n1 . ex:n2 ex:q ex:n4 .", {},
         "data.ttl");
  }
  Path wrap(Path::Kind kind, std::vector<Path> parts) { return {kind, {}, std::move(parts)}; }
  Lines from(const char* start, const Path& path) {
    Lines found;
    for (const Id id : nodes_at(path, iri(start), data())) found.push_back(name(id));
    return found;
  }
  Path p = Path::of(iri("p")), q = Path::of(iri("q"));
};

TEST_F(PathTest, LeadsToEachNodeOnce) {
  using Kind = Path::Kind;
  EXPECT_EQ(from("n1", p), (Lines{"n2"}));
  EXPECT_EQ(from("n1", wrap(Kind::kInverse, {p})), (Lines{"n3"}));
  EXPECT_EQ(from("n1", wrap(Kind::kSequence, {p, q})), (Lines{"n4"}));
  EXPECT_EQ(from("n4", wrap(Kind::kInverse, {wrap(Kind::kSequence, {p, q})})), (Lines{"n1"}));
  EXPECT_EQ(from("n2", wrap(Kind::kAlternative, {q, p, q})), (Lines{"n4", "n3"}));
  EXPECT_EQ(from("n1", wrap(Kind::kZeroOrMore, {p})), (Lines{"n1", "n2", "n3"}));
  EXPECT_EQ(from("n1", wrap(Kind::kOneOrMore, {p})), (Lines{"n2", "n3", "n1"}));
  EXPECT_EQ(from("n1", wrap(Kind::kZeroOrOne, {p})), (Lines{"n1", "n2"}));
  EXPECT_EQ(from("absent", wrap(Kind::kZeroOrMore, {p})), (Lines{"absent"}));
  EXPECT_EQ(from("n4", wrap(Kind::kInverse,
                            {wrap(Kind::kZeroOrMore, {wrap(Kind::kAlternative, {p, q})})})),
            (Lines{"n4", "n2", "n1", "n3"}));
}

TEST_F(PathTest, IsWrittenAsInSparql) {
  using Kind = Path::Kind;
  const Path path = wrap(
      Kind::kSequence,
      {wrap(Kind::kInverse, {p}), wrap(Kind::kAlternative, {p, wrap(Kind::kZeroOrMore, {q})})});
  EXPECT_EQ(to_sparql(path, store.terms()),
            "((^<http://example.org/p>)/(<http://example.org/p>|(<http://example.org/q>*)))");
}

TEST_F(PathTest, EndsOnLongLists) {
  std::string text = "ex:list ex:members (";
  for (int i = 0; i < 20'000; ++i) text += std::to_string(i) + " ";
  load(text + ") .", {}, "list.ttl");
  const auto rdf = [&](const char* local) {
    return Path::of(
        store.terms().iri("http://www.w3.org/1999/02/22-rdf-syntax-ns#" + std::string(local)));
  };
  const Path members =
      wrap(Path::Kind::kSequence,
           {Path::of(iri("members")), wrap(Path::Kind::kZeroOrMore, {rdf("rest")}), rdf("first")});
  EXPECT_EQ(nodes_at(members, iri("list"), data()).size(), 20'000u);
}

}  // namespace
}  // namespace sinew::rdf::shacl
