// Statistics by query: what SPARQL counts in the algorithm's graph is what C++ counts in the
// program.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "command.h"

namespace sinew::test {
namespace {

using Json = nlohmann::ordered_json;

const std::string kStatistics = SINEW_SOURCE_DIR "/statistics/";

std::vector<std::string> stats_of_gen3(const std::string& solver,
                                       const std::vector<std::string>& options) {
  std::vector<std::string> arguments = {"stats"};
  for (const auto& file : gen3_models()) arguments.push_back(file.string());
  arguments.insert(arguments.end(),
                   {"--solver", solver, "--gravity", "0,0,-9.81", "--format", "json"});
  if (solver == "hybrid")
    arguments.insert(arguments.end(), {"--constraint", "link7:linear-z,angular-x"});
  arguments.insert(arguments.end(), options.begin(), options.end());
  return arguments;
}

Json run_json(const std::vector<std::string>& arguments) {
  const Result result = run_sinew(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return Json::parse(result.out);
}

// The one row of a statistic.
int number(const Json& answer, const std::string& variable, std::size_t row = 0) {
  return std::stoi(answer["results"]["bindings"].at(row)[variable]["value"].get<std::string>());
}

class Statistics : public testing::TestWithParam<std::string> {};

// C++ walks the lowered program once, in its order; SPARQL knows nothing of an order, and adds
// depths to the graph until there is nothing left to add.
TEST_P(Statistics, TheLongestChainByQueryIsThatOfTheProgram) {
  const Json counted = run_json(stats_of_gen3(GetParam(), {}));
  const Json asked =
      run_json(stats_of_gen3(GetParam(), {"--weave", SINEW_SOURCE_DIR "/weaves/depths.rq", "-q",
                                          kStatistics + "longest-chain.rq"}));
  EXPECT_EQ(number(asked, "longestChain"), counted["scheduled"]["longest_chain"].get<int>());
  EXPECT_GT(number(asked, "closures"), number(asked, "longestChain"));
}

// Optimised as a whole, a program computes less than its closures one by one; never more.
TEST_P(Statistics, TheOperationsByQueryAreNoLessThanThoseOfTheOptimisedProgram) {
  const Json counted = run_json(stats_of_gen3(GetParam(), {}))["operations"];
  const Json asked =
      run_json(stats_of_gen3(GetParam(), {"-q", kStatistics + "total-operations.rq"}));
  EXPECT_GE(number(asked, "additions"), counted["add"].get<int>());
  EXPECT_GE(number(asked, "multiplications"), counted["multiply"].get<int>());
  EXPECT_GE(number(asked, "sinesAndCosines"), counted["sincos"].get<int>());
}

TEST_P(Statistics, TheRowsOfEachOperatorAddUpToTheTotal) {
  const Json rows = run_json(stats_of_gen3(GetParam(), {"-q", kStatistics + "operations.rq"}));
  const Json total =
      run_json(stats_of_gen3(GetParam(), {"-q", kStatistics + "total-operations.rq"}));
  for (const char* kind : {"additions", "multiplications", "divisions"}) {
    int sum = 0;
    for (std::size_t i = 0; i < rows["results"]["bindings"].size(); ++i)
      sum += number(rows, kind, i);
    EXPECT_EQ(sum, number(total, kind)) << kind;
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheGen3, Statistics,
                         testing::Values("fpk", "rnea", "aba", "crba", "hybrid"),
                         [](const auto& info) { return info.param; });

TEST(StatisticsByQuery, AllThatShipAnswer) {
  for (const char* name : {"fan-out", "longest-chain", "memory", "operations",
                           "operations-of-links", "operators", "total-operations"}) {
    const Json answer =
        run_json(stats_of_gen3("fpk", {"--weave", SINEW_SOURCE_DIR "/weaves/depths.rq", "-q",
                                       kStatistics + name + ".rq"}));
    EXPECT_FALSE(answer["results"]["bindings"].empty()) << name;
  }
}

TEST(StatisticsByQuery, AWeaveThatNeverSettlesIsAnError) {
  const Folder folder;
  // A fresh node in every round.
  write_file(
      folder / "endless.rq",
      "INSERT { ?algorithm sa:note [ sa:of ?algorithm ] } WHERE { ?algorithm a sa:Algorithm }");
  const Result result = run_sinew(stats_of_gen3(
      "fpk", {"--weave", (folder / "endless.rq").string(), "-q", kStatistics + "operators.rq"}));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("endless.rq:1"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("still changes something after 10000 rounds"), std::string::npos)
      << result.err;
}

TEST(Weave, SaysWhyItFindsNothingToChange) {
  const Folder folder;
  std::vector<std::string> synth = {"synth"};
  for (const auto& file : gen3_models()) synth.push_back(file.string());
  const std::string algorithm = (folder / "algorithm.jsonld").string();
  synth.insert(synth.end(),
               {"--solver", "gravity", "--robot", "print", "--safe", "0", "-o", algorithm});
  ASSERT_EQ(run_sinew(synth).exit_code, 0);
  const auto weave = [&](const std::string& name) {
    return run_sinew({"weave", algorithm, SINEW_SOURCE_DIR "/weaves/" + name}).err;
  };
  EXPECT_NE(weave("torque-checker.rq").find("add --model ROBOT"), std::string::npos);
  EXPECT_NE(weave("depths.rq").find("add --facts"), std::string::npos);
  EXPECT_NE(weave("log-damping.rq").find("finds nothing to change"), std::string::npos);
}

TEST(StatisticsByQuery, WithoutAQueryAWeaveIsBadUsage) {
  const Result result =
      run_sinew(stats_of_gen3("fpk", {"--weave", SINEW_SOURCE_DIR "/weaves/depths.rq"}));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("give -q FILE"), std::string::npos);
}

}  // namespace
}  // namespace sinew::test
