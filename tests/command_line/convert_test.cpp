// sinew convert: what is asked for is done or refused, and nothing that is given is left unread.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "command.h"

namespace sinew::test {
namespace {

using testing::HasSubstr;

Result convert(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(),
                   {"convert", SINEW_SOURCE_DIR "/examples/conversions/frames.blocks"});
  return run_sinew(arguments);
}

const std::string kTwist = "0,0,0,1,0,0";  // 1 m/s along the tool's x
// The tool half a turn about z from the base: its x is the base's -x.
const std::string kHalfATurn = "0,0,0,0,0,1,0";

TEST(Convert, ComputesWithARelationThatIsGiven) {
  const Result result = convert(
      {"tool_twist", "base_twist", "--values", kTwist, "--with", "tool in base=" + kHalfATurn});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "0,0,0,-1,0,0\n");
}

TEST(Convert, SaysWhichRelationIsMissing) {
  const Result result = convert({"tool_twist", "base_twist", "--values", kTwist});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("tool in base: the conversion needs this relation"));
}

TEST(Convert, RefusesARelationThatNothingReads) {
  const std::string good = "tool in base=" + kHalfATurn;
  const struct {
    std::vector<std::string> given;
    const char* error;
  } cases[] = {
      {{good, "camera in base=" + kHalfATurn},
       "--with \"camera in base\": the conversion does not read it; give tool in base"},
      {{good, good}, "--with \"tool in base\": it is given twice"},
      {{"tool in base"}, "--with \"tool in base\": no numbers follow its name"},
  };
  for (const auto& [given, error] : cases) {
    std::vector<std::string> arguments = {"tool_twist", "base_twist", "--values", kTwist};
    for (const std::string& one : given) arguments.insert(arguments.end(), {"--with", one});
    const Result result = convert(arguments);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, HasSubstr(error));
  }
  const Result none =
      convert({"plain_quaternion", "plain_quaternion", "--values", "0,0,0,1", "--with", good});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("leave it out: the conversion needs no relation"));
}

TEST(Convert, RefusesOptionsThatGoWithOthers) {
  const std::vector<std::vector<std::string>> cases = {
      {"tool_twist", "base_twist", "--with", "tool in base=" + kHalfATurn},
      {"tool_twist", "base_twist", "--name", "f"},
      {"--explain"},
      {"--emit", "c"},
      {"--values", "1"},
      {"--allow-lossy"}};
  for (const std::vector<std::string>& arguments : cases) {
    const Result result = convert(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments.back() << result.out;
    EXPECT_THAT(result.err, HasSubstr(" requires ")) << arguments.back();
  }
}

}  // namespace
}  // namespace sinew::test
