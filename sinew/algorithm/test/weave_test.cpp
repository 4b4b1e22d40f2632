#include "sinew/algorithm/weave.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "composition.h"
#include "sinew/algorithm/read.h"

namespace sinew::algorithm {
namespace {

using graph::Id;
using testing::HasSubstr;

constexpr const char* kPrefixes = R"(
PREFIX sa: <https://w3id.org/sinew/algorithm#>
PREFIX so: <https://w3id.org/sinew/operators#>
PREFIX algo: <https://comp-rob2b.github.io/metamodels/algorithm#>
PREFIX geom: <https://comp-rob2b.github.io/metamodels/geometry/spatial-operators#>
PREFIX rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#>
PREFIX unit: <http://qudt.org/vocab/unit/>
PREFIX qudt: <http://qudt.org/schema/qudt/>
PREFIX ex: <https://example.org/>
)";

class WeaveTest : public testing::Test {
 protected:
  Id iri(const std::string& name) { return composition_.iri(name); }
  WeaveCounts weave_text(const std::string& update) {
    return weave(store_, algorithm_, kPrefixes + update, "update.rq");
  }

  Composition composition_;
  graph::Store& store_ = composition_.store;
  Id algorithm_ = composition_.algorithm;
};

// Splices a closure in after the last one of the schedule, as listing 8 of the published
// description does with a logger.
constexpr const char* kAddInverse = R"(
DELETE { ?last rdf:rest rdf:nil }
INSERT {
  ?last rdf:rest [ rdf:first ex:inverse ; rdf:rest rdf:nil ] .
  ?algorithm sa:closure ex:inverse ; sa:data ex:X_DA .
  ex:inverse a so:invert-pose ; so:pose ?pose ; so:inverse ex:X_DA .
  ex:X_DA a sa:DataBlock ; sa:name "X_DA.D" ; sa:quantity "pose" ; sa:of ?a ; sa:with-respect-to ?d ;
    sa:role sa:internal ; sa:size 12 ; sa:output true ; qudt:unit unit:UNITLESS, unit:M .
}
WHERE {
  ?algorithm a sa:Algorithm ; sa:schedule/algo:trigger-chain/rdf:rest* ?last .
  ?last rdf:rest rdf:nil .
  ?compose a geom:ComposePose ; geom:composite ?pose .
  ?pose sa:of ?d ; sa:with-respect-to ?a .
})";

TEST_F(WeaveTest, SplicesAClosureIntoTheSchedule) {
  const WeaveCounts counts = weave_text(kAddInverse);
  EXPECT_EQ(counts.removed, 1u);
  const Algorithm woven = read_checked(store_.view(), algorithm_);
  ASSERT_EQ(woven.schedule.size(), 2u);
  EXPECT_EQ(woven.closures[woven.schedule[1]].op->name, "invert-pose");
  EXPECT_EQ(woven.blocks[3].name, "X_DA.D");
  EXPECT_TRUE(woven.blocks[3].output);
}

TEST_F(WeaveTest, RefusesWhatDoesNotFitAndLeavesTheOldAlgorithm) {
  const Algorithm before = read_checked(store_.view(), algorithm_);
  std::string update = kAddInverse;
  // The inverse with the frames of the pose itself.
  update.replace(update.find("sa:of ?a ; sa:with-respect-to ?d"), 33,
                 "sa:of ?d ; sa:with-respect-to ?a ");
  try {
    weave_text(update);
    FAIL() << "it was woven";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("must hold: inverse.of = pose.with-respect-to"));
  }
  const Algorithm after = read_checked(store_.view(), algorithm_);
  EXPECT_EQ(after.schedule.size(), before.schedule.size());
  EXPECT_EQ(after.blocks.size(), before.blocks.size());
}

TEST_F(WeaveTest, RefusesAnUpdateThatCutsTheSchedule) {
  try {
    weave_text("DELETE { ?s algo:trigger-chain ?l } WHERE { ?s algo:trigger-chain ?l }");
    FAIL() << "it was woven";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("an algorithm without a schedule"));
  }
  EXPECT_NO_THROW(read_checked(store_.view(), algorithm_));
}

TEST_F(WeaveTest, RefusesATextThatIsNoUpdate) {
  EXPECT_THROW(weave_text("SELECT * WHERE { ?s ?p ?o }"), Error);
}

}  // namespace
}  // namespace sinew::algorithm
