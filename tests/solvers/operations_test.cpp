// How many additions and multiplications the solvers take: what docs/performance.md states or
// hardly more, so that no change of a formulation or a pass gives them back unnoticed.
#include <gtest/gtest.h>

#include "question.h"
#include "sinew/program/scalar_program.h"

namespace sinew::test {
namespace {

struct Case {
  std::string robot;
  bool floating;
  std::uint32_t rnea, aba, crba;
};

const std::vector<Case> kCases = {{"clean/gen3.urdf", false, 579, 1197, 343},
                                  {"clean/iiwa.urdf", false, 381, 713, 194},
                                  {"clean/general_7r.urdf", false, 825, 1982, 801},
                                  {"clean/hyq.urdf", true, 1304, 2701, 615}};

constexpr double kMost = 1.01;  // times what is documented

std::uint32_t operations(const Robot& robot, const std::string& solver, bool floating) {
  const Question question(robot, solver, floating);
  const auto count =
      program::count_operations(program::scalar_program(question.program()).computation);
  return count.add + count.multiply;
}

TEST(Operations, AreAsFewAsDocumented) {
  if (published_robots().empty()) GTEST_SKIP() << "no robots in " SINEW_SHARED_DIR "/robots";
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.robot);
    const Robot robot = published_robot(c.robot);
    EXPECT_LE(operations(robot, "rnea", c.floating), kMost * c.rnea);
    EXPECT_LE(operations(robot, "aba", c.floating), kMost * c.aba);
    EXPECT_LE(operations(robot, "crba", c.floating), kMost * c.crba);
  }
}

}  // namespace
}  // namespace sinew::test
