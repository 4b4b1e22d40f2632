// What a query says in C++ is what it says in JSON-LD.
#include "sinew/synthesis/query_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sinew/algorithm/read.h"
#include "sinew/synthesis/combine_queries.h"
#include "sinew/synthesis/read_query.h"
#include "sinew/synthesis/synthesise.h"
#include "small_robot.h"

namespace sinew::synthesis {
namespace {

using testing::HasSubstr;

Query parsed(const std::string& text) {
  return parse_query(text, "query.json", catalogue::Catalogue());
}

const char* const kText = R"({
  "@context": "https://w3id.org/sinew/query.json",
  "@id": "https://example.org/wrist",
  "@type": "Query",
  "name": "wrist",
  "asks": [
    { "@type": "Asked", "quantity": "twist", "of": "tool",
      "with-respect-to": "https://example.org/D-frame", "seen-by": "base" },
    { "@type": "Asked", "quantity": "acceleration-twist", "of": "every-tip" },
    { "@type": "Asked", "quantity": "joint-force", "of": "every-joint" }
  ],
  "gives": [
    { "@type": "Given", "quantity": "joint-position", "of": "every-joint" },
    { "@type": "Given", "quantity": "joint-velocity", "of": "every-joint" },
    { "@type": "Given", "quantity": "joint-acceleration", "of": "every-joint" },
    { "@type": "Given", "quantity": "external-wrench", "of": "tool", "seen-by": "itself" },
    { "@type": "Given", "quantity": "gravity", "varies": true }
  ],
  "tips": ["tool", "D"],
  "forces": "apart",
  "frames": "stationary",
  "holds": [
    { "@type": "Held", "quantity": "gravity" },
    { "@type": "Held", "@id": "https://example.org/rarely", "quantity": "joint-force", "of": "one" }
  ]
})";

Query in_words() {
  return Ask("wrist")
      .the("twist")
      .of("tool")
      .wrt("https://example.org/D-frame")
      .seen_by("base")
      .the("acceleration-twist")
      .of("every-tip")
      .the("joint-force")
      .of("every-joint")
      .given("joint-position")
      .of("every-joint")
      .given("joint-velocity")
      .of("every-joint")
      .given("joint-acceleration")
      .of("every-joint")
      .given("external-wrench")
      .of("tool")
      .seen_by("itself")
      .given("gravity")
      .that_varies()
      .to("tool")
      .to("D")
      .forces(Forces::kApart)
      .frames(Frames::kStationary)
      .holding("gravity")
      .holding("joint-force", "one");
}

TEST(Ask, SaysWhatTheModelSays) {
  Query model = parsed(kText);
  const Query words = in_words();
  // What is given is a set: the order does not matter.
  EXPECT_THAT(model.given, testing::UnorderedElementsAreArray(words.given));
  model.given = words.given;
  EXPECT_THAT(model.held, testing::UnorderedElementsAreArray(words.held));
  model.held = words.held;
  EXPECT_EQ(canonical_text(model), canonical_text(words));
}

TEST(Ask, GivesTheSameAlgorithmAsTheModel) {
  graph::Store one, other;
  write_small_robot(one);
  write_small_robot(other);
  const auto a = algorithm::read_checked(one.view(), synthesise(one, parsed(kText)).algorithm);
  const auto b = algorithm::read_checked(other.view(), synthesise(other, in_words()).algorithm);
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    EXPECT_EQ(a.blocks[i].name, b.blocks[i].name);
    EXPECT_EQ(a.blocks[i].index, b.blocks[i].index);
    EXPECT_EQ(a.blocks[i].value, b.blocks[i].value);
  }
  ASSERT_EQ(a.schedule.size(), b.schedule.size());
  for (std::size_t i = 0; i < a.schedule.size(); ++i) {
    EXPECT_EQ(a.closures[a.schedule[i]].op, b.closures[b.schedule[i]].op);
    EXPECT_EQ(a.closures[a.schedule[i]].arguments, b.closures[b.schedule[i]].arguments);
  }
}

TEST(Held, MarksTheDataBlocksOfWhatIsGivenAskedOrComputedOnTheWay) {
  graph::Store store;
  write_small_robot(store);
  const Query query = Ask(in_words()).holding("velocity-twist", "D-frame");
  const Synthesis synthesis = synthesise(store, query);
  const auto model = algorithm::read_checked(store.view(), synthesis.algorithm);
  std::vector<std::string> held;
  for (const algorithm::Block& block : model.blocks)
    if (block.held) held.push_back(block.name);
  EXPECT_THAT(held, testing::IsSupersetOf({"gravity", "force.one", "body-twist.D-frame"}));
  EXPECT_THAT(held, testing::Not(testing::Contains("force.two")));
  EXPECT_THAT(synthesis.why,
              testing::IsSupersetOf({testing::HasSubstr("held: gravity (1 data block): changes"),
                                     testing::HasSubstr("held: joint-force of one")}));
}

TEST(Held, RefusesWhatThereIsNothingOf) {
  const std::pair<Query, std::string> refused[] = {
      {Ask(named_query("fpk")).holding("mass-matrix"),
       "mass-matrix: it is to be held, but is neither given, nor asked, nor computed on the way; "
       "hold one of"},
      {Ask(named_query("fpk")).holding("pose", "nobody"), "of nobody, but there is none of that"},
      {Ask(named_query("rnea")).with_gravity(0, 0, -9.81).holding("gravity"),
       "gravity: it is to be held, but is a constant; let it vary"},
      {Ask(named_query("fpk")).holding("joint-velocity"), "joint-velocity: it is to be held, but"}};
  for (const auto& [query, expected] : refused) {
    graph::Store store;
    write_small_robot(store);
    try {
      synthesise(store, query);
      FAIL() << expected;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(expected));
    }
  }
}

TEST(Combined, AsksAndGivesEachThingOnce) {
  const Query queries[] = {named_query("fpk"), named_query("rnea"), named_query("bias")};
  const Query all = combined(queries);
  EXPECT_EQ(all.name, "fpk_rnea_bias");
  EXPECT_EQ(all.asked.size(), 3u);
  EXPECT_EQ(all.given.size(), 4u);
}

TEST(Combined, RefusesQueriesThatDifferInWhatThereIsOne) {
  const Query queries[] = {Ask("a").the("pose").from("link1"), Ask("b").the("pose").from("link2")};
  try {
    combined(queries);
    FAIL() << "two bases";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("a query of another base"));
  }
}

}  // namespace
}  // namespace sinew::synthesis
