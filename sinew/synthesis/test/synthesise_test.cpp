#include "sinew/synthesis/synthesise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "refusal.h"
#include "sinew/algorithm/read.h"
#include "sinew/synthesis/read_query.h"
#include "small_robot.h"

namespace sinew::synthesis {
namespace {

using algorithm::Block;
using algorithm::Role;
using testing::ElementsAre;
using testing::HasSubstr;

class SynthesiseTest : public testing::Test {
 protected:
  SynthesiseTest() { write_small_robot(store_); }

  algorithm::Algorithm algorithm_of(const Query& query) {
    return algorithm::read_checked(store_.view(), synthesise(store_, query).algorithm);
  }

  static std::vector<std::string> names(const algorithm::Algorithm& algorithm, bool outputs) {
    std::vector<std::string> found;
    for (const Block& block : algorithm.blocks)
      if (outputs ? block.output : block.role == Role::kInput) found.push_back(block.name);
    return found;
  }

  static std::size_t count(const algorithm::Algorithm& algorithm, std::string_view operation) {
    std::size_t found = 0;
    for (const algorithm::Closure& closure : algorithm.closures)
      found += closure.op->name == operation;
    return found;
  }

  std::string fault(const Query& query) {
    return refusal([&] { synthesise(store_, query); });
  }

  graph::Store store_;
};

TEST_F(SynthesiseTest, TakesAllPositionsThenVelocitiesThenAccelerationsInJointOrder) {
  EXPECT_THAT(
      names(algorithm_of(named_query("rnea")), false),
      ElementsAre("position.one", "position.two", "position.three", "position.four", "velocity.one",
                  "velocity.two", "velocity.three", "velocity.four", "acceleration.one",
                  "acceleration.two", "acceleration.three", "acceleration.four"));
}

TEST_F(SynthesiseTest, HandsOutForcesInJointOrderWithTheUnitOfTheJoint) {
  const algorithm::Algorithm rnea = algorithm_of(named_query("rnea"));
  EXPECT_THAT(names(rnea, true),
              ElementsAre("force.one", "force.two", "force.three", "force.four"));
  for (const Block& block : rnea.blocks) {
    if (block.name == "force.one") {
      EXPECT_EQ(block.unit, "N-M");
    }
    if (block.name == "force.three") {
      EXPECT_EQ(block.unit, "N");
    }
  }
}

TEST_F(SynthesiseTest, HandsOutInMemoryWhatTheGraphSays) {
  for (const char* solver : {"fpk", "jacobian", "rnea", "aba", "crba", "energy"}) {
    // Alone it leaves nothing in the graph.
    const graph::Stamp before = store_.view().stamp();
    const Synthesis alone =
        synthesise(store_, named_query(solver), nullptr, AlgorithmGraph::kIfNeeded);
    EXPECT_TRUE(store_.view().stamp() == before);
    ASSERT_TRUE(alone.model.has_value());
    const algorithm::Algorithm& memory = *alone.model;
    const Synthesis written = synthesise(store_, named_query(solver));
    const algorithm::Algorithm graph = algorithm::read_checked(store_.view(), written.algorithm);
    EXPECT_EQ(memory.id, graph.id);
    EXPECT_EQ(memory.schedule, graph.schedule);
    const auto facts = [](const Block& b) {
      return std::tie(b.id, b.slot, b.name, b.quantity, b.represents, b.symbols, b.unit, b.role,
                      b.output, b.held, b.index, b.size, b.value);
    };
    ASSERT_EQ(memory.blocks.size(), graph.blocks.size());
    for (std::size_t i = 0; i < graph.blocks.size(); ++i)
      EXPECT_EQ(facts(memory.blocks[i]), facts(graph.blocks[i])) << solver << ", block " << i;
    ASSERT_EQ(memory.closures.size(), graph.closures.size());
    for (std::size_t i = 0; i < graph.closures.size(); ++i) {
      const algorithm::Closure &a = memory.closures[i], &b = graph.closures[i];
      EXPECT_EQ(std::tie(a.id, a.op, a.arguments, a.step, a.about),
                std::tie(b.id, b.op, b.arguments, b.step, b.about))
          << solver << ", closure " << i;
    }
  }
}

TEST_F(SynthesiseTest, UsesTheOperatorOfEachJointsKind) {
  const algorithm::Algorithm rnea = algorithm_of(named_query("rnea"));
  EXPECT_EQ(count(rnea, "position-to-pose-revolute"), 3u);
  EXPECT_EQ(count(rnea, "position-to-pose-prismatic"), 1u);
  EXPECT_EQ(count(rnea, "newton-euler-wrench"), 3u);
  EXPECT_EQ(count(rnea, "newton-euler-wrench-across-revolute"), 1u);  // D ends behind a revolute
  EXPECT_EQ(count(rnea, "accumulate-wrench"), 3u);  // onto A twice, onto B once, not onto the base
}

TEST_F(SynthesiseTest, LinksEveryClosureToItsStepAndElement) {
  for (const algorithm::Closure& closure : algorithm_of(named_query("rnea")).closures) {
    EXPECT_TRUE(closure.step) << closure.op->name;
    EXPECT_TRUE(closure.about) << closure.op->name;
  }
}

TEST_F(SynthesiseTest, GivesTheSameAlgorithmForTheSameModelAndQuery) {
  const graph::Id first = synthesise(store_, named_query("rnea")).algorithm;
  const algorithm::Algorithm before = algorithm::read_checked(store_.view(), first);
  EXPECT_EQ(synthesise(store_, named_query("rnea")).algorithm, first);
  const algorithm::Algorithm after = algorithm::read_checked(store_.view(), first);
  ASSERT_EQ(before.blocks.size(), after.blocks.size());
  for (std::size_t i = 0; i < before.blocks.size(); ++i) {
    EXPECT_EQ(before.blocks[i].id, after.blocks[i].id);
    EXPECT_EQ(before.blocks[i].name, after.blocks[i].name);
  }
  EXPECT_EQ(before.schedule, after.schedule);
}

TEST_F(SynthesiseTest, GivesAnotherAlgorithmForAnotherQueryInTheSameStore) {
  const graph::Id rnea = synthesise(store_, named_query("rnea")).algorithm;
  const graph::Id crba = synthesise(store_, named_query("crba")).algorithm;
  EXPECT_NE(rnea, crba);
  EXPECT_NO_THROW(algorithm::read_checked(store_.view(), rnea));
  EXPECT_NO_THROW(algorithm::read_checked(store_.view(), crba));
}

TEST_F(SynthesiseTest, LeavesNothingBehindWhenItFails) {
  const std::size_t before = store_.view().size();
  Query query = named_query("rnea");
  query.given.pop_back();
  query.asked.push_back({"jacobian", "https://example.org/nowhere", ""});
  EXPECT_THROW(synthesise(store_, query), Error);
  EXPECT_EQ(store_.view().size(), before);
}

TEST_F(SynthesiseTest, LooksOnlyAtTheWayToTheTips) {
  Query query = named_query("fpk");
  query.tips = {"D"};
  const algorithm::Algorithm fpk = algorithm_of(query);
  EXPECT_THAT(names(fpk, false), ElementsAre("position.one", "position.four"));
  EXPECT_THAT(names(fpk, true), ElementsAre("pose.D-frame"));
}

TEST_F(SynthesiseTest, AnswersForFramesThatAreFixedToABody) {
  Query query = named_query("fvk");
  query.tips = {"tool"};
  const algorithm::Algorithm fvk = algorithm_of(query);
  EXPECT_THAT(names(fvk, true), ElementsAre("twist.tool"));
  for (const Block& block : fvk.blocks) {
    if (block.name != "twist.tool") continue;
    const auto symbol = [&](algorithm::Attribute attribute) {
      return store_.terms().text(block.symbols[static_cast<std::size_t>(attribute)]);
    };
    EXPECT_EQ(symbol(algorithm::Attribute::kOf), "https://example.org/C");
    EXPECT_EQ(symbol(algorithm::Attribute::kWrt), "https://example.org/base");
    EXPECT_EQ(symbol(algorithm::Attribute::kReference), "https://example.org/tool");
    EXPECT_EQ(symbol(algorithm::Attribute::kSeenBy), "https://example.org/base-frame");
  }
}

TEST_F(SynthesiseTest, SharesWhatSeveralThingsNeed) {
  Query both = named_query("rnea");
  both.asked.push_back({"mass-matrix", "", ""});
  both.asked.push_back({"pose", "https://example.org/tool", ""});
  const std::size_t together = algorithm_of(both).closures.size();
  Query pose = named_query("fpk");
  pose.tips = {"https://example.org/tool"};
  const std::size_t apart = algorithm_of(named_query("rnea")).closures.size() +
                            algorithm_of(named_query("crba")).closures.size() +
                            algorithm_of(pose).closures.size();
  EXPECT_LT(together, apart);
  EXPECT_EQ(count(algorithm_of(both), "position-to-pose-revolute"), 3u);
}

TEST_F(SynthesiseTest, MakesZeroEntriesOfTheMassMatrixForJointsOnDifferentBranches) {
  const algorithm::Algorithm crba = algorithm_of(named_query("crba"));
  // one, two, three: 6 entries; four with one and itself: 2 more.
  EXPECT_EQ(count(crba, "force-from-wrench-revolute") + count(crba, "force-from-wrench-prismatic"),
            8u);
  for (const Block& block : crba.blocks) {
    if (block.name == "mass-matrix") {
      EXPECT_EQ(block.size, 16u);
    }
  }
}

TEST_F(SynthesiseTest, WorksAsASweepConfigurationSays) {
  Query by_hand = named_query("rnea");
  by_hand.sweeps = "rnea-by-hand";
  const algorithm::Algorithm planned = algorithm_of(named_query("rnea"));
  const algorithm::Algorithm written = algorithm_of(by_hand);
  ASSERT_EQ(planned.schedule.size(), written.schedule.size());
  for (std::size_t i = 0; i < planned.schedule.size(); ++i)
    EXPECT_EQ(planned.closures[planned.schedule[i]].op->name,
              written.closures[written.schedule[i]].op->name);
}

TEST_F(SynthesiseTest, PutsAFloatingBaseFirstWithItsSevenAndSixNumbers) {
  Query query = named_query("rnea");
  query.floating = true;
  const std::size_t before = store_.view().size();
  const algorithm::Algorithm rnea = algorithm_of(query);
  EXPECT_EQ(names(rnea, false).front(), "position.base");
  EXPECT_EQ(names(rnea, true).front(), "force.base");
  for (const Block& block : rnea.blocks) {
    if (block.name == "position.base") {
      EXPECT_EQ(block.size, 7u);
    } else if (block.name == "force.base") {
      EXPECT_EQ(block.size, 6u);
    }
  }
  // The tree itself is as it was: what floats is known to this algorithm alone.
  graph::Transaction transaction = store_.begin();
  transaction.clear(rnea.id);
  transaction.commit();
  EXPECT_EQ(store_.view().size(), before);
  EXPECT_EQ(names(algorithm_of(named_query("rnea")), false).front(), "position.one");
}

// The joint about z cannot tell masses on its axis, so the predecessor carries them.
TEST_F(SynthesiseTest, RegroupsInertiasUnlessTheQueryOrSomethingAskedForbidsIt) {
  const auto mass_of_D = [&](const Query& query) {
    for (const Block& block : algorithm_of(query).blocks)
      if (block.name == "inertia.D") return block.value.at(0);
    return -1.0;
  };
  Query query = named_query("rnea");
  EXPECT_EQ(mass_of_D(query), 0.0);
  query.regroup = false;
  EXPECT_EQ(mass_of_D(query), 1.5);
}

// What bodies need at the bias goes inward with what drives them, unless bias forces are asked too.
TEST_F(SynthesiseTest, CarriesOneSumOfWrenchesInwardForForwardDynamics) {
  Query query = named_query("aba");
  EXPECT_EQ(count(algorithm_of(query), "accumulate-wrench"), 3u);
  query.asked.push_back({"bias-force", std::string(kEveryJoint), ""});
  EXPECT_EQ(count(algorithm_of(query), "accumulate-wrench"), 6u);
}

TEST_F(SynthesiseTest, RefusesForwardDynamicsOfALeafWithoutInertia) {
  const Id property = store_.terms().iri("https://w3id.org/sinew/kinematic-tree#inertia");
  const Id D = example(store_, "D");
  store_.remove({D, property, store_.view().object(D, property),
                 store_.terms().iri(model::kNormalisedGraph)});
  EXPECT_THAT(fault(named_query("aba")),
              HasSubstr("https://example.org/D: it ends a chain and has no inertia"));
}

TEST_F(SynthesiseTest, RefusesAnUnknownFrameAndSaysWhichThereAre) {
  Query query = named_query("fpk");
  query.tips = {"hand"};
  EXPECT_THAT(fault(query), HasSubstr("hand: no frame or link of the tree has this name"));
  EXPECT_THAT(fault(query), HasSubstr("one of A, B, C, D, base"));
}

TEST_F(SynthesiseTest, RefusesAnUnknownQuantityDriverAndJoint) {
  Query query = named_query("rnea");
  query.asked.push_back({"colour", "", ""});
  EXPECT_THAT(fault(query), HasSubstr("nothing is known of colour"));
  query = named_query("rnea");
  query.given.push_back({"temperature", ""});
  EXPECT_THAT(fault(query), HasSubstr("there is no driver temperature"));
  query = named_query("rnea");
  query.asked = {{"joint-force", "https://example.org/five", ""}};
  EXPECT_THAT(fault(query), HasSubstr("no moving joint has this name"));
}

TEST_F(SynthesiseTest, RefusesAMissingDriverAndSaysWhichToAdd) {
  Query query = named_query("rnea");
  std::erase_if(query.given, [](const Given& given) { return given.quantity == "joint-velocity"; });
  EXPECT_THAT(fault(query), HasSubstr("joint-force cannot be computed without joint-velocity"));
  EXPECT_THAT(fault(query), HasSubstr("add joint-velocity to what the query gives"));
}

TEST_F(SynthesiseTest, RefusesContradictoryAndRepeatedDrivers) {
  Query query = named_query("rnea");
  query.given.push_back({"joint-force", std::string(kEveryJoint)});
  EXPECT_THAT(fault(query), HasSubstr("they contradict each other"));
  query = named_query("rnea");
  query.given.push_back(query.given.front());
  EXPECT_THAT(fault(query), HasSubstr("joint-position is given twice"));
}

TEST_F(SynthesiseTest, RefusesAQueryThatAsksForNothing) {
  EXPECT_THAT(fault(Query{}), HasSubstr("the query asks for nothing"));
}

TEST_F(SynthesiseTest, RefusesABaseThatTheTreeDoesNotStartFrom) {
  Query query = named_query("rnea");
  query.base = "A";
  EXPECT_THAT(fault(query), HasSubstr("it is not the base of the tree"));
}

TEST(Synthesise, RefusesAStoreWithoutANormalisedTree) {
  graph::Store store;
  EXPECT_THROW(synthesise(store, named_query("rnea")), Error);
}

TEST(NamedQueries, AreAllReadable) {
  for (const std::string& name : named_queries()) {
    EXPECT_EQ(named_query(name).name, name);
    EXPECT_FALSE(named_query(name).asked.empty()) << name;
  }
  EXPECT_THROW(named_query("no-such-solver"), Error);
}

TEST(ParseQuery, ReadsWhatIsAskedGivenAndFilledIn) {
  const Query query = parse_query(R"({
    "@context": "https://w3id.org/sinew/query.json",
    "@id": "https://example.org/q", "@type": "Query", "name": "mine",
    "asks": [ { "@type": "Asked", "quantity": "pose", "of": "https://example.org/tool" },
              { "@type": "Asked", "quantity": "joint-force", "of": "every-joint" } ],
    "gives": [ { "@type": "Given", "quantity": "joint-position", "of": "every-joint" } ],
    "tips": [ "https://example.org/tool" ], "gravity": [0, 0, -9.81], "floating": true })",
                                  "mine.json", catalogue::Catalogue());
  EXPECT_EQ(query.name, "mine");
  ASSERT_EQ(query.asked.size(), 2u);
  EXPECT_EQ(query.asked[0].of, "https://example.org/tool");
  EXPECT_EQ(query.asked[1].of, kEveryJoint);
  EXPECT_EQ(query.tips, std::vector<std::string>{"https://example.org/tool"});
  EXPECT_EQ((*query.gravity)[2], -9.81);
  EXPECT_TRUE(query.floating);
}

TEST(ParseQuery, RefusesAQuestionWithoutAQuantityWithItsPlace) {
  try {
    parse_query(R"({
      "@context": "https://w3id.org/sinew/query.json",
      "@id": "https://example.org/q", "@type": "Query",
      "asks": [ { "@id": "https://example.org/a", "@type": "Asked" } ] })",
                "mine.json", catalogue::Catalogue());
    FAIL() << "it was read";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("mine.json:4: https://example.org/a: lacks quantity"));
  }
}

}  // namespace
}  // namespace sinew::synthesis
