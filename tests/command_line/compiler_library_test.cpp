// The just-in-time compiler lies in a library of its own, which may be missing or left by another
// version. Then sinew says so and interprets, with the same results.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "command.h"

namespace sinew::test {
namespace {

using testing::HasSubstr;

// Runs inverse dynamics of the Gen3 with this as its compiler's library; "" for the one it finds.
Result torques(const std::string& library) {
  const Folder folder;
  write_file(folder / "states.csv",
             "position.joint1,position.joint2,position.joint3,position.joint4,position.joint5,"
             "position.joint6,position.joint7\n0.1,0.2,0.3,0.4,0.5,0.6,0.7\n");
  std::vector<std::string> arguments = {"run"};
  for (const auto& model : gen3_models()) arguments.push_back(model.string());
  for (const std::string more : {"--solver", "gravity", "--input"}) arguments.push_back(more);
  arguments.push_back((folder / "states.csv").string());
  if (!library.empty()) setenv("SINEW_JIT_LIBRARY", library.c_str(), 1);
  Result result = run_sinew(arguments);
  unsetenv("SINEW_JIT_LIBRARY");
  return result;
}

TEST(CompilerLibrary, OfAnotherVersionIsRefusedBeforeItIsCalled) {
  const Result found = torques("");
  ASSERT_EQ(found.exit_code, 0) << found.err;
  const Result other = torques(SINEW_OTHER_JIT_LIBRARY);
  ASSERT_EQ(other.exit_code, 0) << other.err;
  EXPECT_THAT(other.err, HasSubstr("interpreting, since " SINEW_OTHER_JIT_LIBRARY
                                   " belongs to another version (it has no sinew_jit_compile_"));
  const Columns compiled = columns_of(found.out), interpreted = columns_of(other.out);
  ASSERT_EQ(compiled.size(), 7u);
  for (const auto& [name, values] : compiled) {
    ASSERT_EQ(interpreted.count(name), 1u) << name;
    ASSERT_EQ(values.size(), 1u);
    EXPECT_NEAR(interpreted.at(name)[0], values[0], 1e-12) << name;
  }
}

TEST(CompilerLibrary, ThatIsNotWhereTheEnvironmentSaysIsNotSoughtElsewhere) {
  const Result result = torques("/nowhere/libsinew_jit.so");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("interpreting, since /nowhere/libsinew_jit.so is not there"));
}

}  // namespace
}  // namespace sinew::test
