// The traversal framework with steps that only write down what they are called for.
#include "sinew/synthesis/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sinew/synthesis/joint_edge.h"
#include "small_robot.h"

namespace sinew::synthesis {
namespace {

using testing::ElementsAre;

class SweepTest : public testing::Test {
 protected:
  SweepTest() { write_small_robot(store_); }

  std::string name(Id id) { return std::string(algorithm::short_name(store_.terms().text(id))); }

  // A step that notes "PASS PARENT>NODE" or "PASS NODE".
  Step recorder(const std::string& step_name, Direction direction, Visitor visitor) {
    const auto note = [this, step_name](const std::string& pass) {
      return [this, step_name, pass](Context&, const Visit& visit) {
        log_.push_back(step_name + " " + pass + " " +
                       (visit.parent ? name(visit.parent) + ">" : "") + name(visit.node));
      };
    };
    visitor.configure = note("configure");
    visitor.compute = note("compute");
    return {step_name, "", direction, std::string(kAcrossJoints), {}, {}, {}, {visitor}};
  }

  TraversalCounts run(std::span<const Sweep> sweeps) {
    graph::Transaction transaction = store_.begin();
    const graph::View view = transaction.view();
    algorithm::Builder builder(store_, transaction, example(store_, "algorithm"));
    const Robot robot = read_robot(store_, view);
    const Query query;
    Context context{.store = store_,
                    .view = view,
                    .builder = builder,
                    .robot = robot,
                    .query = query,
                    .reference = robot.root_body};
    context.scope = scope_;
    return run_sweeps(context, sweeps);
  }

  graph::Store store_;
  std::vector<std::string> log_;
  std::unordered_set<Id> scope_;
};

TEST_F(SweepTest, GoesOutwardBreadthFirstInTheOrderOfTheJoints) {
  const Step step = recorder("s", Direction::kOutward, {Where::kEdge, {}, {}, {}, {}});
  run({{Sweep{Direction::kOutward, {&step}}}});
  EXPECT_THAT(std::vector(log_.begin(), log_.begin() + 4),
              ElementsAre("s configure base-frame>A-frame", "s configure A-frame>B-frame",
                          "s configure A-frame>D-frame", "s configure B-frame>C-frame"));
}

TEST_F(SweepTest, ConfiguresEverythingBeforeItComputes) {
  const Step step = recorder("s", Direction::kOutward, {Where::kEdge, {}, {}, {}, {}});
  run({{Sweep{Direction::kOutward, {&step}}}});
  ASSERT_EQ(log_.size(), 8u);
  EXPECT_EQ(log_[4], "s compute base-frame>A-frame");
}

TEST_F(SweepTest, GoesInwardInTheOppositeOrder) {
  const Step step = recorder("s", Direction::kInward, {Where::kEdge, {}, {}, {}, {}});
  run({{Sweep{Direction::kInward, {&step}}}});
  EXPECT_THAT(std::vector(log_.begin() + 4, log_.end()),
              ElementsAre("s compute B-frame>C-frame", "s compute A-frame>D-frame",
                          "s compute A-frame>B-frame", "s compute base-frame>A-frame"));
}

TEST_F(SweepTest, VisitsTheRootFirstOnTheWayOutAndLastOnTheWayIn) {
  const Step out = recorder("out", Direction::kOutward, {Where::kNode, {}, {}, {}, {}});
  const Step in = recorder("in", Direction::kInward, {Where::kNode, {}, {}, {}, {}});
  run({{Sweep{Direction::kOutward, {&out}}, Sweep{Direction::kInward, {&in}}}});
  EXPECT_EQ(log_.front(), "out configure base-frame");
  EXPECT_EQ(log_.back(), "in compute base-frame");
}

TEST_F(SweepTest, CallsStepsOfOneNodeInTheOrderOfTheSweep) {
  const Step a = recorder("a", Direction::kOutward, {Where::kEdge, {}, {}, {}, {}});
  const Step b = recorder("b", Direction::kOutward, {Where::kEdge, {}, {}, {}, {}});
  run({{Sweep{Direction::kOutward, {&b, &a}}}});
  EXPECT_EQ(log_[0], "b configure base-frame>A-frame");
  EXPECT_EQ(log_[1], "a configure base-frame>A-frame");
}

TEST_F(SweepTest, CallsAVisitorOnlyWhereItsConditionsHold) {
  const Step leaf =
      recorder("leaf", Direction::kOutward, {Where::kNode, {std::string(kIsLeaf)}, {}, {}, {}});
  const Step root =
      recorder("root", Direction::kOutward, {Where::kNode, {std::string(kIsRoot)}, {}, {}, {}});
  const Step heavy =
      recorder("heavy", Direction::kOutward,
               {Where::kNode, {std::string(kHasNoInertia), std::string(kIsRoot)}, {}, {}, {}});
  run({{Sweep{Direction::kOutward, {&leaf, &root, &heavy}}}});
  EXPECT_THAT(log_,
              testing::UnorderedElementsAre(
                  "leaf configure D-frame", "leaf configure C-frame", "leaf compute D-frame",
                  "leaf compute C-frame", "root configure base-frame", "root compute base-frame",
                  "heavy configure base-frame", "heavy compute base-frame"));
}

TEST_F(SweepTest, RunsAnExpansionOnceForAllStepsThatHaveItAndForAllSweeps) {
  const Step a = recorder("a", Direction::kOutward, {Where::kEdge, {}, {}, {}, {}});
  const Step b = recorder("b", Direction::kOutward, {Where::kEdge, {}, {}, {}, {}});
  const Step c = recorder("c", Direction::kInward, {Where::kEdge, {}, {}, {}, {}});
  const TraversalCounts counts =
      run({{Sweep{Direction::kOutward, {&a, &b}}, Sweep{Direction::kInward, {&c}}}});
  EXPECT_EQ(counts.nodes, 5u);
  EXPECT_EQ(counts.expansions, 5u);  // once a node, not once a step, sweep or pass
}

TEST_F(SweepTest, RunsEachExpansionThatDiffers) {
  const Step a = recorder("a", Direction::kOutward, {Where::kEdge, {}, {}, {}, {}});
  Step b = recorder("b", Direction::kOutward, {Where::kEdge, {}, {}, {}, {}});
  b.expansion = std::string(kToAskedFrames);
  EXPECT_EQ(run({{Sweep{Direction::kOutward, {&a, &b}}}}).expansions, 10u);
}

TEST_F(SweepTest, AsksEachConditionOnceForANode) {
  const Step a =
      recorder("a", Direction::kOutward, {Where::kNode, {std::string(kIsLeaf)}, {}, {}, {}});
  const Step b =
      recorder("b", Direction::kOutward, {Where::kNode, {std::string(kIsLeaf)}, {}, {}, {}});
  EXPECT_EQ(run({{Sweep{Direction::kOutward, {&a, &b}}}}).conditions, 5u);
}

TEST_F(SweepTest, LeavesOutBodiesThatAreOutOfScope) {
  scope_ = {example(store_, "A-frame"), example(store_, "D-frame")};
  const Step step = recorder("s", Direction::kOutward, {Where::kEdge, {}, {}, {}, {}});
  EXPECT_EQ(run({{Sweep{Direction::kOutward, {&step}}}}).nodes, 3u);
}

TEST_F(SweepTest, RefusesALoop) {
  const Id tree = store_.terms().iri(model::kNormalisedGraph);
  const auto term = [&](const char* word) {
    return store_.terms().iri("https://w3id.org/sinew/kinematic-tree#" + std::string(word));
  };
  // Joint "four" also leads to C.
  store_.add({example(store_, "four"), term("successor-frame"), example(store_, "C-frame"), tree});
  const Step step = recorder("s", Direction::kOutward, {Where::kEdge, {}, {}, {}, {}});
  try {
    run({{Sweep{Direction::kOutward, {&step}}}});
    FAIL() << "a loop was traversed";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("https://example.org/C-frame"));
  }
}

}  // namespace
}  // namespace sinew::synthesis
