#include "sinew/graph/terms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "sinew/base/error.h"

namespace sinew::graph {
namespace {

constexpr std::string_view kXsd = "http://www.w3.org/2001/XMLSchema#";
std::string xsd(std::string_view name) { return std::string(kXsd) + std::string(name); }

TEST(Terms, EqualTermsHaveEqualIdsAndDifferentOnesDifferent) {
  Terms terms;
  const std::vector<Id> all = {
      terms.iri("http://x/a"),
      terms.iri("http://x/b"),
      terms.iri(""),
      terms.blank("a"),
      terms.blank("http://x/a"),
      terms.literal("http://x/a"),
      terms.literal("a"),
      terms.literal("a", xsd("token")),
      terms.literal("a", {}, "en"),
      terms.literal("a", {}, "en-GB"),
      terms.literal("ae", {}, "n"),
      terms.literal(""),
      terms.integer(1),
      terms.real(1),
      terms.literal("1"),
      terms.literal("01", xsd("integer")),
      terms.boolean(true),
      terms.literal("true"),
      terms.fresh_blank(),
      terms.fresh_blank(),
  };
  const std::set<Id> distinct(all.begin(), all.end());
  EXPECT_EQ(distinct.size(), all.size());
  EXPECT_FALSE(distinct.contains(Id{}));

  EXPECT_EQ(terms.iri("http://x/a"), all[0]);
  EXPECT_EQ(terms.blank("a"), all[3]);
  EXPECT_EQ(terms.literal("a", xsd("string")), all[6]);
  EXPECT_EQ(terms.literal("a", terms.iri(xsd("token"))), all[7]);
  EXPECT_EQ(terms.literal("a", {}, "en"), all[8]);
  EXPECT_EQ(terms.literal("1", xsd("integer")), all[12]);
}

TEST(Terms, LookingUpDoesNotAdd) {
  Terms terms;
  const std::size_t before = terms.size();
  EXPECT_FALSE(terms.find_iri("http://x/a"));
  EXPECT_FALSE(terms.find_blank("a"));
  EXPECT_FALSE(terms.find_literal("a"));
  EXPECT_FALSE(terms.find_literal("a", "http://x/unknown-datatype"));
  EXPECT_EQ(terms.size(), before);
  const Id literal = terms.literal("a", {}, "en");
  EXPECT_EQ(terms.find_literal("a", {}, "en"), literal);
  EXPECT_FALSE(terms.find_literal("a", {}, "de"));
}

TEST(Terms, GivesBackWhatWasPutIn) {
  Terms terms;
  const Id literal = terms.literal("Grüße", {}, "de-AT");
  EXPECT_EQ(terms.text(literal), "Grüße");
  EXPECT_EQ(terms.language(literal), "de-AT");
  EXPECT_EQ(terms.text(terms.datatype(literal)),
            "http://www.w3.org/1999/02/22-rdf-syntax-ns#langString");
  const Id plain = terms.literal("x");
  EXPECT_EQ(terms.text(terms.datatype(plain)), xsd("string"));
  EXPECT_EQ(terms.language(plain), "");
  EXPECT_EQ(terms.datatype(terms.iri("http://x/a")), Id{});
  EXPECT_EQ(terms.kind(Id{}), TermKind::kNone);
  const std::string large(100'000, 'x');
  EXPECT_EQ(terms.text(terms.literal(large)), large);
  const std::string with_zero("a\0b", 3);
  EXPECT_EQ(terms.text(terms.literal(with_zero)), with_zero);
}

struct NumberCase {
  const char* lexical;
  const char* datatype;
  std::optional<double> value;
};

TEST(Terms, KnowsTheValuesOfNumericLiterals) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<NumberCase> cases = {
      {"42", "integer", 42.0},
      {"+042", "integer", 42.0},
      {"-0", "integer", 0.0},
      {"4.0", "integer", std::nullopt},
      {"", "integer", std::nullopt},
      {"-", "integer", std::nullopt},
      {" 1", "integer", std::nullopt},
      {"1.", "decimal", 1.0},
      {".5", "decimal", 0.5},
      {".", "decimal", std::nullopt},
      {"1e3", "decimal", std::nullopt},
      {"-1.5E-3", "double", -0.0015},
      {"1e", "double", std::nullopt},
      {"INF", "double", infinity},
      {"-INF", "float", -infinity},
      {"inf", "double", std::nullopt},
      {"0x10", "double", std::nullopt},
      {"nan", "double", std::nullopt},
      {"1e400", "double", infinity},
      {"-1e400", "double", -infinity},
      {"1e-400", "double", 0.0},
      {"1e99999999999999999999", "double", infinity},
      {"0.1", "float", static_cast<double>(0.1f)},
      {"127", "byte", 127.0},
      {"128", "byte", std::nullopt},
      {"-128", "byte", -128.0},
      {"-129", "byte", std::nullopt},
      {"0", "positiveInteger", std::nullopt},
      {"-1", "nonNegativeInteger", std::nullopt},
      {"18446744073709551615", "unsignedLong", 18446744073709551615.0},
      {"18446744073709551616", "unsignedLong", std::nullopt},
      {"1", "string", std::nullopt},
  };
  Terms terms;
  for (const NumberCase& c : cases) {
    const auto value = terms.number(terms.literal(c.lexical, xsd(c.datatype)));
    EXPECT_EQ(value, c.value) << c.lexical << " as " << c.datatype;
  }
  EXPECT_TRUE(std::isnan(*terms.number(terms.literal("NaN", xsd("double")))));
  const std::string tiny = "0." + std::string(400, '0') + "1", huge = "1" + std::string(400, '0');
  EXPECT_EQ(terms.number(terms.literal(tiny, xsd("decimal"))), 0.0);
  EXPECT_EQ(terms.number(terms.literal(huge, xsd("decimal"))), infinity);
  EXPECT_EQ(terms.number(terms.literal(huge, xsd("integer"))), infinity);
  EXPECT_EQ(terms.number(terms.iri("1")), std::nullopt);
}

TEST(Terms, KnowsIntegersExactly) {
  Terms terms;
  const auto value = [&](const char* text, const char* type) {
    return terms.integer_value(terms.literal(text, xsd(type)));
  };
  EXPECT_EQ(value("9223372036854775807", "integer"), INT64_MAX);
  EXPECT_EQ(value("-9223372036854775808", "long"), INT64_MIN);
  EXPECT_EQ(value("9223372036854775808", "integer"), std::nullopt);
  EXPECT_EQ(value("0007", "int"), 7);
  EXPECT_EQ(value("7.0", "decimal"), std::nullopt);
  EXPECT_EQ(terms.integer_value(terms.integer(-5)), -5);
}

TEST(Terms, WritesDoublesSoThatTheyReadBackTheSame) {
  Terms terms;
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (std::isnan(value)) continue;
    EXPECT_EQ(terms.number(terms.real(value)), value);
  }
  EXPECT_EQ(terms.text(terms.real(0.1)), "0.1");
  EXPECT_EQ(terms.text(terms.real(-INFINITY)), "-INF");
}

TEST(Terms, FreshBlankNodesGetLabelsThatNothingElseHas) {
  Terms terms;
  const Id fresh = terms.fresh_blank();
  const std::string label(terms.text(fresh));
  EXPECT_TRUE(terms.is_blank(fresh));
  const Id labelled = terms.blank(label);
  EXPECT_NE(labelled, fresh);
  EXPECT_NE(terms.text(labelled), label);
  EXPECT_EQ(terms.find_blank(label), labelled);
  EXPECT_NE(terms.blank(terms.text(labelled)), labelled);
}

TEST(Terms, PrintsNTriples) {
  Terms terms;
  EXPECT_EQ(terms.to_string(terms.iri("http://x/a")), "<http://x/a>");
  EXPECT_EQ(terms.to_string(terms.iri("http://x/a b")), "<http://x/a\\u0020b>");
  EXPECT_EQ(terms.to_string(terms.blank("b")), "_:b");
  EXPECT_EQ(terms.to_string(terms.literal("a\"\\\n\x01")), "\"a\\\"\\\\\\n\\u0001\"");
  EXPECT_EQ(terms.to_string(terms.literal("a", {}, "en")), "\"a\"@en");
  EXPECT_EQ(terms.to_string(terms.integer(3)), "\"3\"^^<http://www.w3.org/2001/XMLSchema#integer>");
}

// ---- derived nodes ----

TEST(DerivedNode, IsKnownByItsParts) {
  Terms terms;
  const Id role = terms.iri("http://x/pose"), a = terms.iri("http://x/a"),
           b = terms.iri("http://x/b");
  const Id pose = terms.derived(role, {a, b});
  EXPECT_EQ(terms.derived(role, {a, b}), pose);
  EXPECT_NE(terms.derived(role, {b, a}), pose);
  EXPECT_NE(terms.derived(role, {a}), pose);
  EXPECT_NE(terms.derived(a, {role, b}), pose);
  EXPECT_EQ(terms.kind(pose), TermKind::kDerived);
  EXPECT_TRUE(terms.is_iri(pose));
}

TEST(DerivedNode, HasAnIriThatDependsOnTextsOnly) {
  Terms one, other;
  other.iri("http://x/something-else");
  std::string names[2];
  Terms* dictionaries[] = {&one, &other};
  for (int i = 0; i < 2; ++i) {
    Terms& terms = *dictionaries[i];
    const Id inner = terms.derived(terms.iri("http://x/frame"), {terms.literal("a", {}, "en")});
    const Id node = terms.derived(terms.iri("http://x/pose"),
                                  {inner, terms.iri("http://x/b"), terms.integer(3)});
    names[i] = terms.text(node);
  }
  EXPECT_EQ(names[0], names[1]);
  // Computed independently: uuid5(uuid5(URL namespace, prefix), the name as name_of makes it).
  EXPECT_EQ(names[0].substr(0, kDerivedPrefix.size()), kDerivedPrefix);
  EXPECT_EQ(names[0].size(), kDerivedPrefix.size() + 36);
  EXPECT_EQ(names[0][kDerivedPrefix.size() + 14], '5');
}

// The beginnings of names are remembered: whatever was named before, a node's name is its own.
TEST(DerivedNode, IriIsTheSameInWhateverOrderNamesAreMade) {
  std::vector<std::string> first;
  for (int order = 0; order < 4; ++order) {
    Terms terms;
    std::vector<Id> nodes;
    for (int role = 0; role < 9; ++role)
      for (int part = 0; part < 30; ++part) {
        const Id of = terms.iri("http://x/role" + std::to_string(role));
        const Id a = part == 0 ? Id{} : terms.literal("part", xsd("token") + std::to_string(part));
        const Id b = terms.iri("http://x/part" + std::to_string(part));
        for (const std::vector<Id>& parts :
             {std::vector<Id>{}, {a}, {a, b}, {b, a}, {b}, {a, b, a}})
          nodes.push_back(terms.derived(of, parts));
      }
    std::vector<std::size_t> turns(nodes.size());
    std::iota(turns.begin(), turns.end(), 0);
    if (order > 0) std::shuffle(turns.begin(), turns.end(), std::mt19937(order));
    std::vector<std::string> texts(nodes.size());
    for (const std::size_t k : turns) texts[k] = terms.text(nodes[k]);
    if (order == 0) {
      first = texts;
      EXPECT_EQ(std::set<std::string>(texts.begin(), texts.end()).size(),
                std::set<Id>(nodes.begin(), nodes.end()).size());
    }
    EXPECT_EQ(texts, first) << order;
  }
}

TEST(DerivedNode, NamesDoNotCollideBySplittingTextsDifferently) {
  Terms terms;
  const Id role = terms.iri("r");
  EXPECT_NE(terms.text(terms.derived(role, {terms.iri("ab"), terms.iri("c")})),
            terms.text(terms.derived(role, {terms.iri("a"), terms.iri("bc")})));
  EXPECT_NE(terms.text(terms.derived(role, {terms.iri("a")})),
            terms.text(terms.derived(role, {terms.literal("a")})));
  EXPECT_NE(terms.text(terms.derived(role, {terms.literal("a", "b")})),
            terms.text(terms.derived(role, {terms.literal("a", {}, "b")})));
}

TEST(DerivedNode, IsTheSameTermWhenItsIriIsReadBackAsText) {
  Terms terms;
  const Id role = terms.iri("http://x/pose"), a = terms.iri("http://x/a");
  const Id derived = terms.derived(role, {a});
  const std::string text(terms.text(derived));
  EXPECT_EQ(terms.find_iri(text), derived);
  EXPECT_EQ(terms.iri(text), derived);

  Terms later;
  const Id read = later.iri(text);
  EXPECT_EQ(later.kind(read), TermKind::kIri);
  EXPECT_EQ(later.derived(later.iri("http://x/pose"), {later.iri("http://x/a")}), read);
  EXPECT_EQ(later.derived(later.iri("http://x/pose"), {later.iri("http://x/a")}), read);
}

TEST(DerivedNode, MayBeMadeOfDerivedNodesToAnyDepth) {
  Terms terms;
  const Id role = terms.iri("http://x/next");
  Id node = terms.iri("http://x/first");
  for (int i = 0; i < 100'000; ++i) node = terms.derived(role, {node});
  EXPECT_EQ(terms.text(node).size(), kDerivedPrefix.size() + 36);
}

// ---- limits, copies, threads ----

TEST(Terms, RefuseToGrowBeyondTheirLimit) {
  const std::uint32_t builtin = static_cast<std::uint32_t>(Terms().size());
  Terms terms(builtin + 2);
  const Id a = terms.iri("http://x/a");
  terms.fresh_blank();
  EXPECT_THROW(terms.iri("http://x/b"), Error);
  EXPECT_THROW(terms.fresh_blank(), Error);
  EXPECT_EQ(terms.iri("http://x/a"), a);
  EXPECT_FALSE(terms.find_iri("http://x/b"));
}

TEST(Terms, RefuseALanguageTagThatIsTooLong) {
  Terms terms;
  EXPECT_THROW(terms.literal("a", {}, std::string(kMaxLanguageSize + 1, 'x')), Error);
  EXPECT_NO_THROW(terms.literal("a", {}, std::string(kMaxLanguageSize, 'x')));
}

TEST(Terms, ACopyKeepsIdsAndLivesOnItsOwn) {
  std::unique_ptr<Terms> copy;
  std::vector<Id> ids;
  Id derived, fresh;
  {
    Terms terms;
    for (int i = 0; i < 20'000; ++i) ids.push_back(terms.iri("http://x/" + std::to_string(i)));
    derived = terms.derived(ids[0], {ids[1]});
    fresh = terms.fresh_blank();
    copy = terms.clone();
    terms.iri("http://x/later");
  }
  EXPECT_FALSE(copy->find_iri("http://x/later"));
  for (int i = 0; i < 20'000; ++i) {
    EXPECT_EQ(copy->find_iri("http://x/" + std::to_string(i)), ids[i]);
  }
  EXPECT_EQ(copy->derived(ids[0], {ids[1]}), derived);
  EXPECT_TRUE(copy->text(derived).starts_with(kDerivedPrefix));
  EXPECT_TRUE(copy->text(fresh).starts_with("fresh"));
  EXPECT_EQ(copy->text(copy->iri("http://x/own")), "http://x/own");
}

TEST(Terms, CanBeReadWhileAnotherThreadAdds) {
  Terms terms;
  std::vector<Id> known;
  const Id role = terms.iri("http://x/role");
  for (int i = 0; i < 500; ++i) {
    known.push_back(terms.iri("http://x/" + std::to_string(i)));
    known.push_back(terms.derived(role, {known.back()}));
    known.push_back(terms.literal(std::to_string(i), xsd("integer")));
  }
  std::thread reader([&] {
    for (int round = 0; round < 20; ++round) {
      for (std::size_t i = 0; i < known.size(); i += 3) {
        const int number = static_cast<int>(i / 3);
        EXPECT_EQ(terms.find_iri("http://x/" + std::to_string(number)), known[i]);
        EXPECT_TRUE(terms.text(known[i + 1]).starts_with(kDerivedPrefix));
        EXPECT_EQ(terms.number(known[i + 2]), number);
      }
    }
  });
  for (int i = 0; i < 20'000; ++i) {
    terms.derived(role, {terms.iri("http://y/" + std::to_string(i))});
    if (i % 1000 == 0) terms.iri(std::string(kDerivedPrefix) + std::to_string(i));
  }
  reader.join();
}

}  // namespace
}  // namespace sinew::graph
