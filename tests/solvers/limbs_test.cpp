// Limbs side by side compute what the program computes, one number at a time.
#include <gtest/gtest.h>

#include <random>

#include "compare.h"
#include "humanoid_urdf.h"
#include "question.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/compile.h"
#include "sinew/backend/interpreter.h"
#include "sinew/backend/jit.h"
#include "sinew/program/limbs/limb_program.h"
#include "sinew/program/scalar_program.h"
#include "temporary_urdf.h"

namespace sinew::test {
namespace {

Robot robot(const std::string& name) {
  for (const Robot& r : published_robots()) {
    if (r.name == name) return r;
  }
  return {};
}

struct Case {
  std::string robot, solver;
  bool floating;
};

const std::vector<Case> kCases = {{"clean/hyq.urdf", "rnea", true}, {"clean/hyq.urdf", "aba", true},
                                  {"clean/hyq.urdf", "crba", true}, {"clean/hyq.urdf", "fpk", true},
                                  {"hyq.urdf", "jacobian", true},   {"baxter.urdf", "rnea", false},
                                  {"baxter.urdf", "aba", false}};

// In some states.
void expect_agreement(const program::LimbProgram& limbs, const program::Program& one_by_one) {
  backend::Interpreter interpreter(one_by_one);
  std::mt19937 random(2);
  std::uniform_real_distribution<> number(-1, 1);
  for (int state = 0; state < 20; ++state) {
    peers::Vector in(interpreter.in_size()), expected(interpreter.out_size());
    for (double& x : in) x = number(random);
    interpreter.evaluate(in.data(), expected.data());
    EXPECT_LT(difference(program::evaluate(limbs, in), expected), 1e-11);
  }
}

TEST(Limbs, LegsAndArmsComputeSideBySideWhatTheyComputeOneByOne) {
  if (published_robots().empty()) GTEST_SKIP() << "no robots in " SINEW_SHARED_DIR "/robots";
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.solver + " " + c.robot);
    const Question question(robot(c.robot), c.solver, c.floating);
    const program::ScalarProgram scalar = program::scalar_program(question.program());
    const auto count = program::count_operations(scalar.computation);
    const auto limbs = program::limb_program(scalar.program, count);
    ASSERT_TRUE(limbs.has_value());
    // Four legs are a vector, two arms are half of one; what is left is the trunk.
    const auto lanes = limbs->operations();
    EXPECT_LT(lanes.add + lanes.multiply, (c.floating ? 0.45 : 0.6) * (count.add + count.multiply));
    expect_agreement(*limbs, scalar.program);
  }
}

// A spine looks like a leg as far as it goes, and its head like a hand: neither may keep the two
// legs and the two arms from being found.
TEST(Limbs, BothArmsAndBothLegsOfAHumanoidAreFound) {
  for (const std::uint32_t seed : {1U, 2U}) {
    const TemporaryUrdf humanoid(humanoid_urdf(seed));
    for (const std::string solver : {"fpk", "jacobian", "rnea", "aba", "crba"}) {
      SCOPED_TRACE(solver);
      const Question question(humanoid.robot(), solver, true);
      const program::ScalarProgram scalar = program::scalar_program(question.program());
      const auto count = program::count_operations(scalar.computation);
      const auto limbs = program::limb_program(scalar.program, count);
      ASSERT_TRUE(limbs.has_value());
      // 13 joints in two lanes, 4 in the trunk.
      const auto lanes = limbs->operations();
      EXPECT_EQ(lanes.sincos, solver == "jacobian" ? 14U : 17U);
      EXPECT_LT(lanes.add + lanes.multiply, 0.68 * (count.add + count.multiply));
      expect_agreement(*limbs, scalar.program);
    }
  }
}

TEST(Limbs, GeneratedCAgreesWithTheInterpreterUnderEveryCompilerAndProcessor) {
  if (published_robots().empty()) GTEST_SKIP() << "no robots in " SINEW_SHARED_DIR "/robots";
  // Compilers take long for long functions: three of the cases.
  for (const Case& c : {kCases[0], kCases[2], kCases[5]}) {
    SCOPED_TRACE(c.solver + " " + c.robot);
    const Question question(robot(c.robot), c.solver, c.floating);
    backend::COptions options;
    options.name = "solver";
    const backend::GeneratedCode code = generate_c(question.program(), options);
    ASSERT_TRUE(code.with_limbs.has_value());
    backend::Interpreter interpreter(question.program());
    for (const std::vector<std::string>& compiler :
         std::vector<std::vector<std::string>>{{"gcc", "-march=native"},
                                               {"gcc", "-mtune=generic"},
                                               {"clang-19", "-march=native"},
                                               {"gcc", "-ffast-math"}}) {
      backend::CompileOptions compile;
      compile.compiler = compiler[0];
      compile.flags = {"-O1", "-Wall", "-Wextra", "-Werror", "-std=c11", "-pedantic", compiler[1]};
      const backend::LoadedCode loaded = compile_and_load(code, compile);
      std::mt19937 random(2);
      std::uniform_real_distribution<> number(-1, 1);
      for (int state = 0; state < 100; ++state) {
        peers::Vector in(interpreter.in_size()), expected(interpreter.out_size());
        for (double& x : in) x = number(random);
        if (state == 50) in[7] = 2e5;  // a sine that the C library computes
        peers::Vector out(expected.size());
        interpreter.evaluate(in.data(), expected.data());
        loaded.function()(in.data(), out.data());
        EXPECT_LT(difference(out, expected), 1e-11) << compiler[0] << " " << compiler[1];
      }
    }
  }
}

TEST(Limbs, MachineCodeAgreesWithTheInterpreterAndBatchesDoNotDependOnTheirSize) {
  if (published_robots().empty()) GTEST_SKIP() << "no robots in " SINEW_SHARED_DIR "/robots";
  std::string why;
  if (!backend::jit_available(&why)) GTEST_SKIP() << why;
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.solver + " " + c.robot);
    const Question question(robot(c.robot), c.solver, c.floating);
    backend::Interpreter interpreter(question.program());
    const backend::JitFunction function = backend::jit_compile(
        program::scalar_program(question.program()), {backend::JitLevel::kFast, ""});
    constexpr std::size_t kSamples = 19;
    const std::size_t in_size = interpreter.in_size(), out_size = interpreter.out_size();
    std::mt19937 random(8);
    std::uniform_real_distribution<> number(-1, 1);
    peers::Vector rows(in_size * kSamples), all(out_size * kSamples);
    for (double& x : rows) x = number(random);
    rows[7 * kSamples + 3] = 1e6;  // a sine that the C library computes
    function.batch(rows.data(), all.data(), kSamples);
    for (std::size_t k = 0; k < kSamples; ++k) {
      peers::Vector in(in_size), expected(out_size), out(out_size), alone(out_size);
      for (std::size_t i = 0; i < in_size; ++i) in[i] = rows[i * kSamples + k];
      interpreter.evaluate(in.data(), expected.data());
      function(in.data(), out.data());
      EXPECT_LT(difference(out, expected), 1e-11) << k;
      function.batch(in.data(), alone.data(), 1);
      for (std::size_t i = 0; i < out_size; ++i) EXPECT_EQ(alone[i], all[i * kSamples + k]) << k;
    }
  }
}

TEST(Limbs, AreComputedOneByOneWhereThatIsAsked) {
  if (published_robots().empty()) GTEST_SKIP() << "no robots in " SINEW_SHARED_DIR "/robots";
  const Question question(robot("clean/hyq.urdf"), "rnea", true);
  backend::COptions options;
  options.name = "solver";
  options.limbs = false;
  const backend::GeneratedCode code = generate_c(question.program(), options);
  EXPECT_FALSE(code.with_limbs.has_value());
  EXPECT_EQ(code.files[1].text.find("limbs"), std::string::npos);
}

TEST(Limbs, OfASerialArmAreNone) {
  if (published_robots().empty()) GTEST_SKIP() << "no robots in " SINEW_SHARED_DIR "/robots";
  const Question question(robot("clean/iiwa.urdf"), "rnea");
  const program::ScalarProgram scalar = program::scalar_program(question.program());
  EXPECT_FALSE(
      program::limb_program(scalar.program, program::count_operations(scalar.computation)));
}

}  // namespace
}  // namespace sinew::test
