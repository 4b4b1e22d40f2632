// Robots at the edge of what a robot is: without joints, without mass where it matters, with names
// that no programmer would choose.
#include <gtest/gtest.h>

#include <regex>

#include "command.h"

namespace sinew::test {
namespace {

constexpr const char* kInertial =
    "<inertial><origin xyz='0.1 0 0.2'/><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01' "
    "ixy='0' ixz='0' iyz='0'/></inertial>";

std::string link(const std::string& name, const std::string& inertial = kInertial) {
  return "<link name='" + name + "'>" + inertial + "</link>\n";
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin xyz='0 0 0.3'/>" +
         (type == "fixed" ? "" : "<axis xyz='0 0 1'/>") + "</joint>\n";
}

class OddRobot : public testing::Test {
 protected:
  Result stats(const std::string& content, std::vector<std::string> more) const {
    write_file(folder_ / "odd.urdf", "<robot name='odd'>\n" + content + "</robot>\n");
    std::vector<std::string> arguments = {"stats", (folder_ / "odd.urdf").string(), "--gravity",
                                          "0,0,-9.81"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_sinew(arguments);
  }
  void expect_refused(const std::string& content, const std::vector<std::string>& more,
                      const std::string& expected) const {
    const Result result = stats(content, more);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(std::regex_search(result.err, std::regex(expected)))
        << result.err << "\nlacks " << expected;
  }

  Folder folder_;
};

TEST_F(OddRobot, WithoutAJointThatMovesHasNothingToAnswer) {
  const std::string fixed = link("a") + link("b") + joint("ab", "fixed", "a", "b");
  for (const std::string solver : {"rnea", "aba", "crba", "bias", "gravity", "cholesky", "com"})
    expect_refused(fixed, {"--solver", solver},
                   "it is asked, but the robot has no joint that moves; ask of a robot with "
                   "joints that move, or let its base float");
  expect_refused(fixed, {"--solver", "fpk"},
                 "pose: it is asked of every tip, but no link moves, so there is none; name the "
                 "frame of which it is asked");
  EXPECT_EQ(stats(fixed, {"--ask", "pose of b", "--give", "joint-position"}).exit_code, 0);
  for (const std::string solver : {"rnea", "aba", "crba", "fpk"})
    EXPECT_EQ(stats(fixed, {"--solver", solver, "--floating"}).exit_code, 0) << solver;
}

TEST_F(OddRobot, WithoutMassHasNoCentreOfItAndNoEnergy) {
  const std::string massless =
      "<link name='a'/><link name='b'/>" + joint("ab", "continuous", "a", "b");
  for (const auto& [solver, asked] :
       {std::pair{"com", "center-of-mass"}, {"energy", "kinetic-energy"}, {"momentum", "momentum"}})
    expect_refused(massless, {"--solver", solver},
                   asked + std::string(": it is asked, but nothing of the robot has mass; state "
                                       "masses of links"));
  for (const std::string solver : {"fpk", "rnea", "crba"})
    EXPECT_EQ(stats(massless, {"--solver", solver}).exit_code, 0) << solver;
}

TEST_F(OddRobot, WithTwoJointsOnOneAxisAndNothingBetweenHasNoAcceleration) {
  const std::string content = "<link name='a'/>\n<link name='b'/>\n" + link("c") +
                              joint("ab", "continuous", "a", "b") +
                              joint("bc", "continuous", "b", "c");
  write_file(folder_ / "odd.urdf", "<robot name='odd'>\n" + content + "</robot>\n");
  write_file(folder_ / "rows.csv", "position.ab\n0\n");
  const std::vector<std::vector<std::string>> commands = {
      {"generate"},
      {"bench"},
      {"run", "--input", (folder_ / "rows.csv").string()},
      {"run", "--interpret", "--input", (folder_ / "rows.csv").string()}};
  for (std::vector<std::string> command : commands) {
    command.insert(command.begin() + 1,
                   {(folder_ / "odd.urdf").string(), "--solver", "aba", "--gravity", "0,0,-9.81"});
    const Result result = run_sinew(command);
    EXPECT_EQ(result.exit_code, 1) << command[0];
    EXPECT_TRUE(std::regex_search(
        result.err, std::regex("odd.urdf:5: [^ ]*/joint/ab: its 'joint-acceleration-from-force' "
                               "divides by zero, or overflows, whatever the inputs are; look for")))
        << result.err;
  }
}

TEST_F(OddRobot, OfOneLinkConformsAndFloats) {
  for (const std::string solver : {"rnea", "aba", "crba", "fpk"})
    EXPECT_EQ(stats(link("drone"), {"--solver", solver, "--floating"}).exit_code, 0) << solver;
  const Result check = run_sinew({"check", (folder_ / "odd.urdf").string()});
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_NE(check.out.find("1 bodies, 0 moving joints"), std::string::npos) << check.out;
}

TEST_F(OddRobot, WhoseLastLinkHasNoInertiaAboutItsJointHasNoAcceleration) {
  const std::string massless =
      "<inertial><mass value='0'/><inertia ixx='0' iyy='0' izz='0' ixy='0' "
      "ixz='0' iyz='0'/></inertial>";
  const std::string on_the_axis =
      "<inertial><origin xyz='0 0 0.4'/><mass value='1'/><inertia "
      "ixx='0' iyy='0' izz='0' ixy='0' ixz='0' iyz='0'/></inertial>";
  for (const std::string& inertial : {std::string(), massless, on_the_axis}) {
    const std::string robot = link("a") + link("b", inertial) + joint("ab", "continuous", "a", "b");
    for (const std::string solver : {"aba", "forward_cholesky"})
      expect_refused(robot, {"--solver", solver},
                     "odd.urdf:3: .*link/b: it ends a chain and has no inertia.*; state its "
                     "inertia, or make its joint a fixed one");
    for (const std::string solver : {"rnea", "crba", "fpk"})
      EXPECT_EQ(stats(robot, {"--solver", solver}).exit_code, 0) << solver;
  }
  expect_refused(
      link("a", "") + link("b") + joint("ab", "continuous", "a", "b"),
      {"--solver", "aba", "--floating"},
      "odd.urdf:2: .*link/a: it floats, has no mass, and nothing holds it but one joint");
}

TEST_F(OddRobot, MayHaveNamesWithSpacesAndOfOtherAlphabets) {
  const std::string robot = link("base link") + link("Glied ä") + link("手") +
                            joint("joint one", "continuous", "base link", "Glied ä") +
                            joint("关节", "continuous", "Glied ä", "手");
  EXPECT_EQ(stats(robot, {"--solver", "rnea", "--base", "base link", "--tip", "手"}).exit_code, 0);
  EXPECT_EQ(
      stats(robot, {"--ask", "pose of 手 wrt base%20link", "--give", "joint-position"}).exit_code,
      0);
  const std::vector<std::string> wrench = {
      "--ask",  "joint-wrench of 关节", "--give", "joint-position", "--give", "joint-velocity",
      "--give", "joint-acceleration",   "--give", "gravity"};
  EXPECT_EQ(stats(robot, wrench).exit_code, 0);
}

TEST_F(OddRobot, OfOneJointOrOfSixtyIsAnswered) {
  std::string chain = link("l0");
  for (int k = 1; k <= 60; ++k)
    chain += link("l" + std::to_string(k)) +
             joint("j" + std::to_string(k), k % 3 == 0 ? "floating" : "continuous",
                   "l" + std::to_string(k - 1), "l" + std::to_string(k));
  for (const std::string solver : {"rnea", "aba", "fpk"})
    EXPECT_EQ(stats(chain, {"--solver", solver}).exit_code, 0) << solver;
  for (const std::string solver : {"rnea", "aba", "crba", "jacobian", "cholesky"})
    EXPECT_EQ(
        stats(link("a") + link("b") + joint("ab", "continuous", "a", "b"), {"--solver", solver})
            .exit_code,
        0)
        << solver;
}

}  // namespace
}  // namespace sinew::test
