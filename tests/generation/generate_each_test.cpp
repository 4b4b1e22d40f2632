// Several functions of one robot in one go are, byte for byte, what each is alone.
#include "generate_each.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "arm_urdf.h"
#include "humanoid_urdf.h"
#include "refusal.h"
#include "sinew/base/error.h"
#include "temporary_folder.h"

namespace sinew::test {
namespace {

using backend::GeneratedCode;

class GenerateEach : public testing::Test {
 protected:
  GenerateEach() { query_.gravity = "0,0,-9.81"; }

  cli::ModelOptions robot(const std::string& urdf) const {
    const std::filesystem::path file = folder_ / "robot.urdf";
    std::ofstream(file) << urdf;
    cli::ModelOptions files;
    files.files = {file.string()};
    return files;
  }

  // One call with models of its own.
  static GeneratedCode alone(const cli::ModelOptions& files, const cli::QueryOptions& question,
                             const std::string& prefix, backend::COptions options = {}) {
    const auto models = cli::load(files);
    options.name = cli::function_name(prefix, question);
    options.source = cli::describe(files, question);
    return backend::generate_c(cli::program_of(*models, files, question, options.name), options);
  }

  static void expect_equal(const GeneratedCode& code, const GeneratedCode& expected) {
    ASSERT_EQ(code.files.size(), expected.files.size());
    for (std::size_t k = 0; k < code.files.size(); ++k) {
      EXPECT_EQ(code.files[k].name, expected.files[k].name);
      EXPECT_TRUE(code.files[k].text == expected.files[k].text) << code.files[k].name;
    }
  }

  // What is wrong, as a user reads it; empty where nothing is.
  std::string refusal(const cli::ModelOptions& files) const {
    return sinew::refusal([&] {
      const auto models = cli::load(files);
      cli::generate_each(*models, files, cli::each_solver(query_), "", {});
    });
  }

  TemporaryFolder folder_;
  cli::QueryOptions query_;
};

TEST_F(GenerateEach, GivesTheSameBytesAsOneCallForEach) {
  const cli::ModelOptions files = robot(kArm);
  query_.solver = "fpk,jacobian,rnea,aba,crba,gravity";
  const std::vector<cli::QueryOptions> questions = cli::each_solver(query_);
  ASSERT_EQ(questions.size(), 6u);
  for (const unsigned threads : {1U, 2U, 8U}) {
    SCOPED_TRACE(threads);
    const auto models = cli::load(files);
    const std::vector<GeneratedCode> codes =
        cli::generate_each(*models, files, questions, "arm", {}, threads);
    ASSERT_EQ(codes.size(), questions.size());
    for (std::size_t k = 0; k < codes.size(); ++k)
      expect_equal(codes[k], alone(files, questions[k], "arm"));
  }
}

TEST_F(GenerateEach, GivesTheSameBytesForAFloatingRobotWithLimbs) {
  const cli::ModelOptions files = robot(humanoid_urdf());
  query_.solver = "aba,fpk,rnea,crba,jacobian";
  query_.floating = true;
  const std::vector<cli::QueryOptions> questions = cli::each_solver(query_);
  const auto models = cli::load(files);
  const std::vector<GeneratedCode> codes = cli::generate_each(*models, files, questions, "", {}, 4);
  ASSERT_EQ(codes.size(), questions.size());
  for (std::size_t k = 0; k < codes.size(); ++k) {
    EXPECT_TRUE(k == 1 || k == 4 || codes[k].with_limbs.has_value());
    expect_equal(codes[k], alone(files, questions[k], ""));
  }
}

TEST_F(GenerateEach, HandsOnWhatHoldsForAllOfThem) {
  const cli::ModelOptions files = robot(kArm);
  query_.solver = "rnea,crba";
  query_.tips = {"tool"};
  query_.ask = {"pose of tool"};
  backend::COptions options;
  options.scalar = backend::Scalar::kFloat;
  options.language = backend::Language::kCpp;
  const auto models = cli::load(files);
  const std::vector<cli::QueryOptions> questions = cli::each_solver(query_);
  const std::vector<GeneratedCode> codes =
      cli::generate_each(*models, files, questions, "", options);
  ASSERT_EQ(codes.size(), 2u);
  EXPECT_EQ(codes[0].files[1].name, "rnea.cpp");
  for (std::size_t k = 0; k < 2; ++k)
    expect_equal(codes[k], alone(files, questions[k], "", options));
}

// Questions about other parts of the robot, seen from elsewhere, between two that are alike: the
// tree that was normalised for one is not taken for another.
TEST_F(GenerateEach, TakesATreeOnlyForTheRobotThatItIsOf) {
  const cli::ModelOptions files = robot(kArm);
  query_.solver = "rnea";
  std::vector<cli::QueryOptions> questions(6, query_);
  questions[1].tips = {"upper"};
  questions[2].gravity = "0,0,-1.62";
  questions[3].base = "tool";
  questions[4].gravity = "input";
  const auto models = cli::load(files);
  const std::vector<GeneratedCode> codes = cli::generate_each(*models, files, questions, "", {});
  for (std::size_t k = 0; k < questions.size(); ++k) {
    SCOPED_TRACE(k);
    expect_equal(codes[k], alone(files, questions[k], ""));
    const bool other_robot = k > 0 && k < 5;
    EXPECT_EQ(codes[k].files[1].text != codes[0].files[1].text, other_robot);
  }
}

TEST_F(GenerateEach, RefusesWhatTheFirstQuestionAtFaultIsRefusedWith) {
  const cli::ModelOptions files = robot(kArm);
  query_.solver = "rnea,abba,crba,feko";
  EXPECT_NE(refusal(files).find("abba: there is no solver of this name; one of "),
            std::string::npos)
      << refusal(files);
  // The back end's refusal of the first comes before the planner's of the second.
  query_.solver = "rnea,feko";
  const auto models = cli::load(files);
  try {
    cli::generate_each(*models, files, cli::each_solver(query_), "no name", {});
    ADD_FAILURE() << "'no name_rnea' names no function";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'no name_rnea' cannot name a C function"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(GenerateEach, WantsSolversEachOnce) {
  const cli::ModelOptions files = robot(kArm);
  query_.solver = "";
  EXPECT_NE(refusal(files).find("--solver"), std::string::npos) << refusal(files);
  query_.solver = "rnea,crba,rnea";
  EXPECT_NE(refusal(files).find("solver 'rnea' is named twice"), std::string::npos)
      << refusal(files);
}

}  // namespace
}  // namespace sinew::test
