// `sinew generate --each`: a function of its own for each solver, in one call.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "arm_urdf.h"
#include "command.h"

namespace sinew::test {
namespace {

class GenerateEachCommand : public testing::Test {
 protected:
  GenerateEachCommand() { write_file(folder_ / "arm.urdf", kArm); }

  Result generate(const std::string& solvers, std::vector<std::string> more,
                  const std::string& to) const {
    std::vector<std::string> arguments = {"generate", (folder_ / "arm.urdf").string(),
                                          "--solver", solvers,
                                          "-o",       (folder_ / to).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_sinew(arguments);
  }

  // The files of a folder, sorted.
  std::vector<std::string> files_in(const std::string& folder) const {
    std::vector<std::string> names;
    if (!std::filesystem::exists(folder_ / folder)) return names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / folder))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  Folder folder_;
};

TEST_F(GenerateEachCommand, WritesTheFilesOfOneCallForEach) {
  std::filesystem::create_directory(folder_ / "each");
  std::filesystem::create_directory(folder_ / "one");
  const Result each = generate("rnea,aba,fpk", {"--each"}, "each");
  ASSERT_EQ(each.exit_code, 0) << each.err;
  for (const char* solver : {"rnea", "aba", "fpk"})
    ASSERT_EQ(generate(solver, {}, "one").exit_code, 0);
  const std::vector<std::string> names = files_in("each");
  EXPECT_THAT(names, testing::ElementsAre("aba.c", "aba.h", "aba.json", "fpk.c", "fpk.h",
                                          "fpk.json", "rnea.c", "rnea.h", "rnea.json"));
  EXPECT_EQ(names, files_in("one"));
  for (const std::string& name : names)
    EXPECT_TRUE(read_file(folder_ / "each" / name) == read_file(folder_ / "one" / name)) << name;
}

TEST_F(GenerateEachCommand, PutsTheNameBeforeTheSolver) {
  std::filesystem::create_directory(folder_ / "out");
  const Result result = generate("rnea,fpk", {"--each", "--name", "arm", "--target", "cpp"}, "out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(files_in("out"),
              testing::ElementsAre("arm_fpk.cpp", "arm_fpk.h", "arm_fpk.hpp", "arm_fpk.json",
                                   "arm_rnea.cpp", "arm_rnea.h", "arm_rnea.hpp", "arm_rnea.json"));
}

TEST_F(GenerateEachCommand, WritesProgramsToo) {
  std::filesystem::create_directory(folder_ / "out");
  ASSERT_EQ(generate("rnea,fpk", {"--each", "--target", "program"}, "out").exit_code, 0);
  EXPECT_THAT(files_in("out"), testing::ElementsAre("fpk.program.json", "rnea.program.json"));
}

TEST_F(GenerateEachCommand, SaysOnceWhatHoldsForAll) {
  std::filesystem::create_directory(folder_ / "out");
  const Result result = generate("rnea,gravity,aba", {"--each"}, "out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::size_t at = result.err.find("no gravity");
  ASSERT_NE(at, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("no gravity", at + 1), std::string::npos) << result.err;
}

TEST_F(GenerateEachCommand, WritesNothingWhereOneCannotBeMade) {
  std::filesystem::create_directory(folder_ / "out");
  const Result result = generate("rnea,abba", {"--each"}, "out");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, testing::HasSubstr("abba: there is no solver of this name"));
  EXPECT_TRUE(files_in("out").empty());
}

TEST_F(GenerateEachCommand, WantsSolvers) {
  const Result result = run_sinew({"generate", (folder_ / "arm.urdf").string(), "--each"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, testing::HasSubstr("--solver"));
  EXPECT_THAT(generate("rnea,rnea", {"--each"}, "out").err, testing::HasSubstr("twice"));
}

}  // namespace
}  // namespace sinew::test
