// A branch composed onto the published arm with one more file, none of the arm's own changed:
// inverse dynamics of a tree against torques of an independent recursion.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "evaluator.h"
#include "pipeline.h"

namespace sinew::test {
namespace {

TEST(Branch, OnThePublishedArmGivesTheReferenceTorques) {
  const std::filesystem::path folder = SINEW_SHARED_DIR "/models/kinova/gen3/7dof";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "the published models are not here: " << folder;
  cli::ModelOptions files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    files.files.push_back(entry.path().string());
  }
  files.files.emplace_back(SINEW_SOURCE_DIR "/tests/solvers/models/gen3_branch.jsonld");
  cli::QueryOptions query;
  query.solver = "rnea";
  const auto models = cli::load(files);
  const program::Program program = cli::program_of(*models, files, query, "");

  std::map<std::string, double> in;
  const double q[] = {0.1, -0.2, 0.3, -0.4, 0.5, -0.6, 0.7},
               qd[] = {0.5, -0.4, 0.3, -0.2, 0.1, 0.6, -0.7},
               qdd[] = {1.0, -0.8, 0.6, -0.4, 0.2, -0.1, 0.3};
  for (int i = 0; i < 7; ++i) {
    const std::string joint = "joint" + std::to_string(i + 1);
    in["position." + joint] = q[i];
    in["velocity." + joint] = qd[i];
    in["acceleration." + joint] = qdd[i];
  }
  in["position.jointB"] = 0.9;
  in["velocity.jointB"] = 1.1;
  in["acceleration.jointB"] = -2;
  const std::map<std::string, double> expected = {
      {"force.joint1", 0.479282727471986},  {"force.joint2", 6.09432497723859},
      {"force.joint3", 0.327904577935636},  {"force.joint4", 3.68574670152786},
      {"force.joint5", 0.192654447404039},  {"force.joint6", 0.711764347907679},
      {"force.joint7", 0.0224545988865983}, {"force.jointB", -0.292233467049947}};

  std::vector<cli::How> ways = {cli::How::kInterpreted};
  if (backend::jit_available()) ways.push_back(cli::How::kCompiled);
  for (const cli::How how : ways) {
    cli::Evaluator evaluator(program, how, backend::JitLevel::kFull);
    std::vector<double> numbers;
    for (const std::string& name : cli::column_names(program, evaluator.interface().inputs)) {
      numbers.push_back(in.at(name));
    }
    const auto outputs = cli::column_names(program, evaluator.interface().outputs);
    std::vector<double> results(outputs.size());
    evaluator.evaluate(numbers.data(), results.data());
    ASSERT_EQ(outputs.size(), expected.size());
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      EXPECT_NEAR(results[i], expected.at(outputs[i]), 1e-12) << outputs[i];
    }
  }
}

}  // namespace
}  // namespace sinew::test
