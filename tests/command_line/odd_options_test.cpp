// Options that cannot do what they say: they are refused, or it is said that they do nothing.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "command.h"

namespace sinew::test {
namespace {

// A wheel on a vertical axle: gravity turns it nowhere, wherever it stands.
constexpr const char* kWheel = R"(<robot name="wheel"><link name="base"/>
<link name="rim"><inertial><mass value="1"/>
  <inertia ixx="1" iyy="1" izz="2" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="axle" type="continuous"><parent link="base"/><child link="rim"/><axis xyz="0 0 1"/></joint>
</robot>)";

class OddOptions : public testing::Test {
 protected:
  OddOptions() { write_file(folder_ / "wheel.urdf", kWheel); }
  Result sinew(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin() + 1, {(folder_ / "wheel.urdf").string(), "--solver", "rnea",
                                             "--gravity", "0,0,-9.81"});
    return run_sinew(arguments);
  }
  Folder folder_;
};

TEST_F(OddOptions, HowCodeIsMadeGoesWithCode) {
  const std::vector<std::vector<std::string>> options = {{"--style", "readable"},
                                                         {"--scalar", "float"},
                                                         {"--trigonometry", "sleef"},
                                                         {"--slow", "position"},
                                                         {"--held", "pose"},
                                                         {"--no-limbs"},
                                                         {"--trace"}};
  for (std::vector<std::string> option : options) {
    const std::string name = option.front();
    option.insert(option.begin(), {"generate", "--target", "program", "-o", folder_.string()});
    const Result result = sinew(option);
    EXPECT_EQ(result.exit_code, 2) << name;
    EXPECT_EQ(result.err.find("sinew generate: " + name + " goes with --target c"), 0u)
        << result.err;
  }
}

TEST_F(OddOptions, AnUpdateThatWouldComputeNothingIsNotWrittenAndThatIsSaid) {
  const auto generate = [&](const std::string& slow) {
    return sinew({"generate", "-o", folder_.string(), "--slow", slow});
  };
  const Result nothing = generate("position");
  EXPECT_EQ(nothing.exit_code, 0) << nothing.err;
  EXPECT_NE(nothing.err.find("rnea.h has no update"), std::string::npos) << nothing.err;
  EXPECT_EQ(read_file(folder_ / "rnea.h").find("rnea_update"), std::string::npos);
  const Result some = generate("acceleration");
  EXPECT_EQ(some.err.find("no update"), std::string::npos) << some.err;
  EXPECT_NE(read_file(folder_ / "rnea.h").find("rnea_update"), std::string::npos);
}

TEST_F(OddOptions, RowsOfASpreadsheetMayBeginWithAByteOrderMark) {
  write_file(folder_ / "rows.csv",
             "\xEF\xBB\xBFposition.axle,velocity.axle,acceleration.axle\r\n0.1,0.2,3\r\n");
  const Result result = sinew({"run", "--input", (folder_ / "rows.csv").string()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "force.axle\n6\n");
}

}  // namespace
}  // namespace sinew::test
