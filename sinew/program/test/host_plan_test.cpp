#include "sinew/program/host_plan.h"

#include <gtest/gtest.h>

#include "sinew/algorithm/attach.h"
#include "sinew/algorithm/builder.h"
#include "sinew/algorithm/weave.h"
#include "sinew/base/error.h"
#include "sinew/program/lower.h"
#include "sinew/program/program_json.h"
#include "sinew/program/validate.h"

namespace sinew::program {
namespace {

using algorithm::Builder;
using graph::Id;

// total = force - kept; kept' = total - force, so that `kept` changes its sign in every cycle.
class HostPlanTest : public testing::Test {
 protected:
  void SetUp() override {
    graph::Transaction transaction = store_.begin();
    Builder builder(store_, transaction, algorithm_);
    const Id joint = iri("joint1"), link = iri("link1"), base = iri("base");
    const auto force = [&](std::string_view slot, algorithm::Role role,
                           std::vector<double> value = {}) {
      return builder.block({.slot = slot,
                            .represents = joint,
                            .quantity = "joint-force",
                            .of = link,
                            .wrt = base,
                            .seen_by = link,
                            .role = role,
                            .value = value});
    };
    const auto given = force("given", algorithm::Role::kInput);
    const auto kept = force("kept", algorithm::Role::kState, {2.0});
    const auto total = force("total", algorithm::Role::kInternal);
    builder.closure("subtract-joint-force", {given, kept, total}, {});
    builder.closure("subtract-joint-force", {total, given, kept}, {});
    builder.output(total, "force.joint1");
    const auto position = builder.block({.slot = "position",
                                         .represents = joint,
                                         .quantity = "joint-position",
                                         .of = link,
                                         .wrt = base,
                                         .seen_by = link,
                                         .role = algorithm::Role::kInput});
    const auto pose = builder.block(
        {.slot = "pose", .represents = link, .quantity = "pose", .of = link, .wrt = base});
    builder.closure("position-to-pose-revolute", {position, pose}, {});
    builder.output(pose);
    builder.finish();
    transaction.commit();
  }

  Id iri(const std::string& name) { return store_.terms().iri("https://example.org/" + name); }
  HostPlan plan() { return plan_for_host(store_.view(), algorithm_, "test"); }
  void weave(const std::string& update) {
    algorithm::weave(store_, algorithm_,
                     "PREFIX sa: <https://w3id.org/sinew/algorithm#>\n"
                     "PREFIX so: <https://w3id.org/sinew/operators#>\n"
                     "PREFIX rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#>\n"
                     "PREFIX algo: <https://comp-rob2b.github.io/metamodels/algorithm#>\n"
                     "PREFIX ex: <https://example.org/>\n" +
                         update,
                     "update.rq");
  }
  // Puts closures behind the first one of the schedule.
  void weave_after_first(const std::string& closure, const std::string& says) {
    weave("DELETE { ?first rdf:rest ?rest } INSERT { ?first rdf:rest [ rdf:first " + closure +
          " ; rdf:rest ?rest ] . ?algorithm sa:closure " + closure + " . " + closure + " " + says +
          " } WHERE { ?algorithm a sa:Algorithm ; sa:schedule/algo:trigger-chain ?first . "
          "?first rdf:rest ?rest . ?total sa:name \"force.joint1\" . ?given sa:name "
          "\"given.joint1\" }");
  }
  std::vector<std::string> operations(const HostPlan& plan) {
    std::vector<std::string> names;
    for (const HostStep& step : plan.steps)
      names.push_back(step.external ? plan.externals[step.index].operation : "pure");
    return names;
  }

  graph::Store store_;
  Id algorithm_ = iri("algorithm");
};

using Names = std::vector<std::string>;

TEST_F(HostPlanTest, HoldsInputsStatesAndOutputs) {
  const HostPlan result = plan();
  ASSERT_EQ(result.segments.size(), 1u);
  EXPECT_EQ(operations(result), Names{"pure"});
  Names blocks;
  for (const Variable& block : result.blocks) blocks.push_back(block.name);
  EXPECT_EQ(blocks, (Names{"given.joint1", "position.joint1", "force.joint1", "pose.link1",
                           "kept.joint1"}));
  require_valid(result.segments[0].program);
}

TEST_F(HostPlanTest, TurnsStatesIntoInputsAndOutputs) {
  const HostPlan result = plan();
  const Segment& segment = result.segments[0];
  for (const Variable& variable : segment.program.variables)
    EXPECT_NE(variable.role, Role::kState) << variable.name;
  const auto named = [&](std::uint32_t block) { return result.blocks[block].name; };
  ASSERT_EQ(segment.inputs.size(), 3u);
  EXPECT_EQ(named(segment.inputs[2]), "kept.joint1");
  ASSERT_EQ(segment.outputs.size(), 3u);
  EXPECT_EQ(named(segment.outputs[2]), "kept.joint1");
}

TEST_F(HostPlanTest, LeavesTheProgramAsItIsWhenARobotIsAttached) {
  const Program before = lower(store_.view(), algorithm_, "test");
  algorithm::attach_robot(store_, algorithm_, {"https://example.org/robot", {0.0}});
  EXPECT_EQ(to_json(lower(store_.view(), algorithm_, "test")), to_json(before));
  const HostPlan result = plan();
  EXPECT_EQ(operations(result), (Names{"read", "pure", "write"}));
  ASSERT_NE(result.externals[0].property("interface"), nullptr);
  EXPECT_EQ(*result.externals[0].property("interface"), "https://example.org/robot");
  EXPECT_EQ(result.blocks[result.externals[0].blocks[0]].name, "position.joint1");
  EXPECT_EQ(result.blocks[result.externals[1].blocks[0]].name, "force.joint1");
  EXPECT_THROW(algorithm::attach_robot(store_, algorithm_, {"https://example.org/robot", {0.0}}),
               Error);
}

TEST_F(HostPlanTest, RefusesARobotWithoutASafeCommand) {
  EXPECT_THROW(algorithm::attach_robot(store_, algorithm_, {"https://example.org/robot", {}}),
               Error);
}

TEST_F(HostPlanTest, RunsALoggerAfterThePureProgramThatItStandsIn) {
  weave_after_first("ex:log", "a so:log ; so:quantity ( ?total ?given ) ; sa:label \"both\"");
  const HostPlan result = plan();
  EXPECT_EQ(operations(result), (Names{"pure", "log"}));
  EXPECT_EQ(*result.externals[0].property("label"), "both");
}

TEST_F(HostPlanTest, ChecksBeforeItWrites) {
  algorithm::attach_robot(store_, algorithm_, {"https://example.org/robot", {0.0}});
  weave(
      "DELETE { ?last rdf:rest rdf:nil } INSERT { ?last rdf:rest [ rdf:first ex:check ; rdf:rest "
      "rdf:nil ] . ?algorithm sa:closure ex:check . ex:check a so:check-range ; so:quantity ( "
      "?total ) ; sa:lower -1.0 ; sa:upper 1.0 ; sa:action sa:stop } WHERE { ?algorithm a "
      "sa:Algorithm ; sa:schedule/algo:trigger-chain/rdf:rest* ?last . ?last rdf:rest rdf:nil . "
      "?total sa:name \"force.joint1\" }");
  EXPECT_EQ(operations(plan()), (Names{"read", "pure", "check-range", "write"}));
}

TEST_F(HostPlanTest, CutsTheProgramWhereAProbeStands) {
  weave_after_first("ex:probe", "a so:probe-time ; sa:label \"halfway\"");
  const HostPlan result = plan();
  EXPECT_EQ(operations(result), (Names{"pure", "probe-time", "pure"}));
  ASSERT_EQ(result.segments.size(), 2u);
  EXPECT_EQ(result.segments[0].program.closures.size(), 1u);
  EXPECT_EQ(result.segments[1].program.closures.size(), 2u);
  for (const Segment& segment : result.segments) require_valid(segment.program);
}

TEST_F(HostPlanTest, RefusesAReadAfterItsQuantityIsUsed) {
  EXPECT_THROW(weave_after_first("ex:read", "a so:read ; so:quantity ( ?given )"), Error);
  EXPECT_EQ(operations(plan()), Names{"pure"});
}

TEST_F(HostPlanTest, RefusesAReadOfWhatTheProgramComputes) {
  EXPECT_THROW(weave_after_first("ex:read", "a so:read ; so:quantity ( ?total )"), Error);
}

}  // namespace
}  // namespace sinew::program
