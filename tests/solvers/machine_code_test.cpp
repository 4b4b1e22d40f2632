// Bytes of machine code that the process makes for a single call: what docs/performance.md states
// or hardly more, so that no change of a plan gives them back unnoticed.
#include <gtest/gtest.h>

#include <array>

#include "humanoid_urdf.h"
#include "question.h"
#include "sinew/backend/jit.h"
#include "sinew/program/scalar_program.h"
#include "temporary_urdf.h"

namespace sinew::test {
namespace {

const std::array<std::string, 5> kSolvers = {"rnea", "aba", "crba", "fpk", "jacobian"};

struct Case {
  std::string robot;
  bool floating;
  std::array<std::size_t, 5> bytes;  // of each solver; 0: not asked
};

constexpr double kMost = 1.02;  // times what is documented

// Code for other processors has other bytes: those of AVX2 address half as many registers, those of
// ARM are four for each instruction.
bool is_documented_processor() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512vl") != 0;
#else
  return false;
#endif
}

void expect_few(const Robot& robot, const Case& c) {
  for (std::size_t k = 0; k < kSolvers.size(); ++k) {
    if (c.bytes[k] == 0) continue;
    SCOPED_TRACE(c.robot + " " + kSolvers[k]);
    const Question question(robot, kSolvers[k], c.floating);
    const backend::JitFunction function = backend::jit_compile(
        program::scalar_program(question.program()), {backend::JitLevel::kFull, "", false});
    EXPECT_LE(static_cast<double>(function.code_bytes()), kMost * static_cast<double>(c.bytes[k]));
  }
}

class MachineCode : public testing::Test {
 protected:
  void SetUp() override {
    std::string why;
    if (!backend::jit_available(&why)) GTEST_SKIP() << "no just-in-time compiler here: " << why;
    if (!is_documented_processor()) GTEST_SKIP() << "the documented bytes are those of AVX-512";
  }
};

TEST_F(MachineCode, IsAsShortAsDocumented) {
  if (published_robots().empty()) GTEST_SKIP() << "no robots in " SINEW_SHARED_DIR "/robots";
  const std::vector<Case> cases = {
      {"clean/gen3.urdf", false, {3526, 6810, 2243, 978, 1476}},
      {"clean/iiwa.urdf", false, {2296, 3997, 1646, 912, 1294}},
      {"clean/general_7r.urdf", false, {4472, 10224, 4313, 1541, 2052}},
      {"clean/hyq.urdf", true, {3643, 6937, 3967, 1639, 2751}},
  };
  for (const Case& c : cases) expect_few(published_robot(c.robot), c);
}

TEST_F(MachineCode, OfAHumanoidIsAsShortAsDocumented) {
  const TemporaryUrdf humanoid(humanoid_urdf(1));
  expect_few(humanoid.robot(), {"humanoid", true, {13620, 29245, 17237, 4207, 8836}});
}

}  // namespace
}  // namespace sinew::test
