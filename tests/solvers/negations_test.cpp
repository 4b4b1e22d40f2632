// How many values the solvers negate, which operation counts do not say: about what
// docs/performance.md states, and none that reads like a sum turned around or a result negated lane
// by lane.
#include <gtest/gtest.h>

#include <array>

#include "humanoid_urdf.h"
#include "question.h"
#include "sinew/program/limbs/limb_signs.h"
#include "sinew/program/passes/choose_signs.h"
#include "sinew/program/scalar_program.h"
#include "temporary_urdf.h"

namespace sinew::test {
namespace {

const std::array<std::string, 5> kSolvers = {"rnea", "aba", "crba", "fpk", "jacobian"};

struct Case {
  std::string robot;
  bool floating;
  std::array<std::uint32_t, 5> negations;  // of each solver, where gcc compiled Sinew
};

// Compiled by another compiler (clang), Sinew may leave a few more, for what C++ leaves open, such
// as roundings and the order of arguments, decides between signs that are as good: far fewer than
// there were before signs were chosen.
std::uint32_t most(std::uint32_t documented) { return 2 + documented + documented / 2; }

// Of a single call, which has limbs side by side where there are any.
std::uint32_t negations(const Question& question) {
  const program::ScalarProgram scalar = program::scalar_program(question.program());
  const auto limbs =
      program::limb_program(scalar.program, program::count_operations(scalar.computation));
  return limbs ? program::count_negations(*limbs) : program::count_negations(scalar.computation);
}

void expect_few(const Robot& robot, const Case& c) {
  for (std::size_t k = 0; k < kSolvers.size(); ++k) {
    SCOPED_TRACE(c.robot + " " + kSolvers[k]);
    EXPECT_LE(negations(Question(robot, kSolvers[k], c.floating)), most(c.negations[k]));
  }
}

TEST(Negations, AreAsFewAsDocumented) {
  if (published_robots().empty()) GTEST_SKIP() << "no robots in " SINEW_SHARED_DIR "/robots";
  const std::vector<Case> cases = {{"clean/gen3.urdf", false, {0, 0, 0, 0, 7}},
                                   {"clean/iiwa.urdf", false, {0, 1, 1, 0, 7}},
                                   {"clean/general_7r.urdf", false, {0, 0, 4, 0, 6}},
                                   {"clean/hyq.urdf", true, {0, 3, 4, 0, 3}}};
  for (const Case& c : cases) expect_few(published_robot(c.robot), c);
}

TEST(Negations, AreFewWhereALimbIsTheMirrorImageOfAnother) {
  const TemporaryUrdf humanoid(humanoid_urdf(1));
  expect_few(humanoid.robot(), {"humanoid", true, {0, 3, 6, 1, 23}});
}

}  // namespace
}  // namespace sinew::test
