#include "sinew/rdf/iri/iri.h"

#include <gtest/gtest.h>

namespace sinew::rdf {
namespace {

TEST(SplitIri, TellsAnAbsentComponentFromAnEmptyOne) {
  const IriParts full = split_iri("http://user@host:80/a/b?q#f");
  EXPECT_EQ(full.scheme, "http");
  EXPECT_EQ(full.authority, "user@host:80");
  EXPECT_EQ(full.path, "/a/b");
  EXPECT_EQ(full.query, "q");
  EXPECT_EQ(full.fragment, "f");

  const IriParts empty = split_iri("x:?#");
  EXPECT_FALSE(empty.authority);
  EXPECT_EQ(empty.path, "");
  EXPECT_EQ(empty.query, "");
  EXPECT_EQ(empty.fragment, "");
  EXPECT_EQ(join_iri(empty), "x:?#");
}

struct Resolution {
  const char* base;
  const char* reference;
  const char* expected;
};

// The examples of RFC 3986, section 5.4, and the corners that its algorithm leads to.
constexpr const char* kBase = "http://a/b/c/d;p?q";
constexpr Resolution kResolutions[] = {
    {kBase, "g:h", "g:h"},
    {kBase, "g", "http://a/b/c/g"},
    {kBase, "./g", "http://a/b/c/g"},
    {kBase, "g/", "http://a/b/c/g/"},
    {kBase, "/g", "http://a/g"},
    {kBase, "//g", "http://g"},
    {kBase, "?y", "http://a/b/c/d;p?y"},
    {kBase, "g?y", "http://a/b/c/g?y"},
    {kBase, "#s", "http://a/b/c/d;p?q#s"},
    {kBase, "g#s", "http://a/b/c/g#s"},
    {kBase, "g?y#s", "http://a/b/c/g?y#s"},
    {kBase, ";x", "http://a/b/c/;x"},
    {kBase, "g;x", "http://a/b/c/g;x"},
    {kBase, "g;x?y#s", "http://a/b/c/g;x?y#s"},
    {kBase, "", "http://a/b/c/d;p?q"},
    {kBase, ".", "http://a/b/c/"},
    {kBase, "./", "http://a/b/c/"},
    {kBase, "..", "http://a/b/"},
    {kBase, "../", "http://a/b/"},
    {kBase, "../g", "http://a/b/g"},
    {kBase, "../..", "http://a/"},
    {kBase, "../../", "http://a/"},
    {kBase, "../../g", "http://a/g"},
    {kBase, "../../../g", "http://a/g"},
    {kBase, "../../../../g", "http://a/g"},
    {kBase, "/./g", "http://a/g"},
    {kBase, "/../g", "http://a/g"},
    {kBase, "g.", "http://a/b/c/g."},
    {kBase, ".g", "http://a/b/c/.g"},
    {kBase, "g..", "http://a/b/c/g.."},
    {kBase, "..g", "http://a/b/c/..g"},
    {kBase, "./../g", "http://a/b/g"},
    {kBase, "./g/.", "http://a/b/c/g/"},
    {kBase, "g/./h", "http://a/b/c/g/h"},
    {kBase, "g/../h", "http://a/b/c/h"},
    {kBase, "g;x=1/./y", "http://a/b/c/g;x=1/y"},
    {kBase, "g;x=1/../y", "http://a/b/c/y"},
    {kBase, "g?y/./x", "http://a/b/c/g?y/./x"},
    {kBase, "g?y/../x", "http://a/b/c/g?y/../x"},
    {kBase, "g#s/../x", "http://a/b/c/g#s/../x"},
    {kBase, "http:g", "http:g"},  // strict
    {"http://a", "b", "http://a/b"},
    {"http://a?q", "b", "http://a/b"},
    {"http://a/b//c", "../d", "http://a/b/d"},
    {"http://a/b", "x//y", "http://a/x//y"},
    {"urn:a/b", "c", "urn:a/c"},
    {"urn:a", "../c", "urn:c"},
    {"urn:a", "..", "urn:"},
    {"file:/a/b", "/..//c", "file:/.//c"},
};

TEST(ResolveIri, FollowsTheExamplesOfTheStandard) {
  for (const auto& [base, reference, expected] : kResolutions) {
    EXPECT_EQ(resolve_iri(reference, base), expected) << reference << " against " << base;
  }
}

TEST(ResolveIri, RefusesARelativeReferenceWithoutAnAbsoluteBase) {
  EXPECT_FALSE(resolve_iri("a", ""));
  EXPECT_FALSE(resolve_iri("a", "b/c"));
  EXPECT_EQ(resolve_iri("x:a", ""), "x:a");
}

TEST(RelativeIri, IsTheShortestFormAndResolvesBack) {
  constexpr const char* kHere = "http://host/robots/arm.json?v=1";
  const std::pair<const char*, const char*> cases[] = {
      {"http://host/robots/arm.json?v=1#joint1", "#joint1"},
      {"http://host/robots/arm.json?v=2", "?v=2"},
      {"http://host/robots/leg.json", "leg.json"},
      {"http://host/robots/", "./"},
      {"http://host/robots/a:b", "./a:b"},
      {"http://host/tools/x", "../tools/x"},
      {"http://host/", "../"},
      {"http://other/x", "http://other/x"},
      {"urn:x", "urn:x"},
  };
  for (const auto& [iri, expected] : cases) {
    EXPECT_EQ(relative_iri(iri, kHere), expected);
    EXPECT_EQ(resolve_iri(relative_iri(iri, kHere), kHere), iri);
  }
}

TEST(FaultOfIri, NamesWhatIsWrong) {
  EXPECT_FALSE(fault_of_iri("http://example.org/ä?x=[1]#y"));
  EXPECT_EQ(fault_of_iri("http://a b"), "the IRI holds a space");
  EXPECT_EQ(fault_of_iri("x:\n"), "the IRI holds a control character");
  EXPECT_EQ(fault_of_iri("x:{y}"), "the IRI holds the character {");
  EXPECT_EQ(fault_of_iri("joint1"), "the IRI has no scheme");
  EXPECT_EQ(fault_of_iri("1:x"), "the IRI has no scheme");
}

TEST(FileIri, EncodesWhatAnIriCannotHold) {
  EXPECT_EQ(file_iri("/a b/c#1/../ä.ttl"), "file:///a%20b/%C3%A4.ttl");
  EXPECT_TRUE(is_absolute_iri(file_iri("here.ttl")));
}

}  // namespace
}  // namespace sinew::rdf
