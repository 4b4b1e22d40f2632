// Robots as heavy, long, light and small as models may be (sinew/model/sizes.h): whatever is asked
// of them is a finite number. Beyond, the fault's line and what would be right.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "command.h"

namespace sinew::test {
namespace {

struct Size {
  double mass, length, moment, gravity, effort = 10;
};

// Three turns about oblique axes, the last of which follows the first, and a slide.
std::string robot(const Size& size) {
  std::string text = "<robot name='r'>\n<link name='l0'/>\n";
  for (int k = 1; k <= 4; ++k) {
    text += fmt::format(
        "<link name='l{0}'><inertial><origin xyz='{1} {2} {1}'/><mass value='{3}'/><inertia "
        "ixx='{4}' iyy='{4}' izz='{4}' ixy='0' ixz='0' iyz='0'/></inertial></link>\n",
        k, 0.3 * size.length, 0.1 * size.length, size.mass, size.moment);
    text += fmt::format(
        "<joint name='j{0}' type='{1}'><parent link='l{2}'/><child link='l{0}'/><origin xyz='0 {3} "
        "{4}'/><axis xyz='0.6 0 0.8'/><limit lower='-{5}' upper='{5}' effort='{5}' "
        "velocity='{5}'/>{6}</joint>\n",
        k, k == 4 ? "prismatic" : "revolute", k - 1, 0.4 * size.length, 0.2 * size.length,
        size.effort, k == 3 ? "<mimic joint='j1' multiplier='-2'/>" : "");
  }
  return text + "</robot>\n";
}

TEST(Sizes, WithinTheLimitsGiveFiniteAnswers) {
  const Folder folder;
  write_file(folder / "rows.csv",
             "position.j1,position.j2,position.j4,velocity.j1,velocity.j2,velocity.j4,"
             "acceleration.j1,acceleration.j2,acceleration.j4,force.j1,force.j2,force.j4,"
             "acceleration-energy.l4.linear-x\n0.3,-0.7,0.2,1,2,-1,0.5,-0.5,1,3,-2,1,0.4\n");
  const Size sizes[] = {{1e12, 3e11, 1e34, 1e12},
                        {1e12, 1e-3, 1e6, 1e12},
                        {1e-30, 1e12, 1e-6, 1e12},
                        {1e-30, 1e-9, 2e-48, 9.81},
                        {1, 0.1, 0.01, 9.81, 1.7976931348623157e308}};
  const std::vector<std::vector<std::string>> questions = {
      {"--solver", "fpk"},
      {"--solver", "jacobian"},
      {"--solver", "rnea"},
      {"--solver", "aba"},
      {"--solver", "crba"},
      {"--solver", "com"},
      {"--solver", "hybrid", "--constraint", "l4:linear-x", "--limit", "l4"}};
  for (const Size& size : sizes) {
    SCOPED_TRACE(fmt::format("{} kg, {} m, {} kg m^2", size.mass, size.length, size.moment));
    write_file(folder / "r.urdf", robot(size));
    for (const std::vector<std::string>& question : questions) {
      SCOPED_TRACE(question[1]);
      std::vector<std::string> arguments = {"run",
                                            (folder / "r.urdf").string(),
                                            "--interpret",
                                            "--input",
                                            (folder / "rows.csv").string(),
                                            "--gravity",
                                            fmt::format("0,0,-{}", size.gravity)};
      arguments.insert(arguments.end(), question.begin(), question.end());
      const Result result = run_sinew(arguments);
      ASSERT_EQ(result.exit_code, 0) << result.err;
      const Columns columns = columns_of(result.out);
      ASSERT_FALSE(columns.empty());
      for (const auto& [name, numbers] : columns)
        for (const double number : numbers) EXPECT_TRUE(std::isfinite(number)) << name;
    }
  }
}

TEST(Sizes, BeyondTheLimitsAreRefusedAtTheirLine) {
  struct Fault {
    Size size;
    std::string expected;
  };
  const Fault faults[] = {
      {{1e308, 0.1, 1, 9.81}, "r.urdf:3: .*the mass is 1e\\+308 kg, more than 1e\\+12 kg; check"},
      {{1e-320, 0, 0, 9.81}, "r.urdf:3: .*not zero, but less than 1e-30 kg; check"},
      {{1, 1e200, 1, 9.81}, "r.urdf:[34]: .*is longer than 1e\\+12 m; check"},
      {{1, 0.1, 1e308, 9.81}, "r.urdf:3: .*a moment of inertia is beyond 1e\\+36 kg m\\^2; check"},
      {{1, 0.1, 1, 1e300}, "the gravity is beyond 1e\\+12 m/s\\^2; give the gravity vector"}};
  const Folder folder;
  for (const Fault& fault : faults) {
    write_file(folder / "r.urdf", robot(fault.size));
    const std::string model = (folder / "r.urdf").string();
    std::vector<std::vector<std::string>> commands = {{"synth", model, "--solver", "rnea",
                                                       "--gravity",
                                                       fmt::format("0,0,-{}", fault.size.gravity)}};
    if (fault.size.gravity < 1e6) commands.push_back({"check", model});
    for (const std::vector<std::string>& command : commands) {
      const Result result = run_sinew(command);
      EXPECT_EQ(result.exit_code, 1) << result.out;
      EXPECT_TRUE(std::regex_search(result.err, std::regex(fault.expected)))
          << result.err << "\nlacks " << fault.expected;
    }
  }
}

}  // namespace
}  // namespace sinew::test
