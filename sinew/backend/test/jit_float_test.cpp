// Machine code made in this process, on floats.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "serial_chain.h"
#include "sinew/backend/interpreter.h"
#include "sinew/backend/jit.h"
#include "sinew/base/error.h"
#include "sinew/program/scalar_program.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::Dag;
using program::Ref;

class JitFloat : public testing::TestWithParam<JitLevel> {
 protected:
  void SetUp() override {
    std::string why;
    if (!jit_available(&why)) GTEST_SKIP() << "no just-in-time compiler here: " << why;
  }
};

program::Program chain() { return test::inverse_dynamics(test::mixed_chain(), true); }

// The largest error over the largest expected number of each sample, for inputs up to `largest`.
double worst_error(const JitFloatFunction& function, std::size_t samples, double largest) {
  Interpreter interpreter(chain());
  std::mt19937 random(7);
  std::uniform_real_distribution<float> number(static_cast<float>(-largest),
                                               static_cast<float>(largest));
  double worst = 0;
  std::vector<float> in(interpreter.in_size()), out(interpreter.out_size());
  std::vector<double> expected(out.size());
  for (std::size_t k = 0; k < samples; ++k) {
    for (float& x : in) {
      x = number(random);
      if (random() % 8 == 0) x = static_cast<float>(std::round(x / M_PI) * M_PI);
    }
    const std::vector<double> exact(in.begin(), in.end());
    interpreter.evaluate(exact.data(), expected.data());
    function(in.data(), out.data());
    double scale = 1;
    for (const double x : expected) scale = std::max(scale, std::abs(x));
    for (std::size_t i = 0; i < out.size(); ++i) {
      worst = std::max(worst, std::abs(out[i] - expected[i]) / scale);
    }
  }
  return worst;
}

TEST_P(JitFloat, AgreesWithTheInterpreterToRoundOff) {
  const JitFloatFunction function =
      jit_compile_float(program::scalar_program(chain()), {GetParam(), ""});
  // 2^-24 = 6e-8 is one rounding; a chain of seven joints rounds some hundred times.
  EXPECT_LT(worst_error(function, 100000, 3.2), 1e-5);
  EXPECT_LT(worst_error(function, 10000, 300.0), 4e-5);
}

TEST_P(JitFloat, ABatchGivesTheBitsOfSingleCallsWhateverItsSize) {
  const program::ScalarProgram program = program::scalar_program(chain());
  const JitFloatFunction function = jit_compile_float(program, {GetParam(), ""});
  const std::size_t inputs = program.computation.inputs,
                    results = program.computation.results.size();
  std::mt19937 random(2);
  std::uniform_real_distribution<float> number(-3, 3);
  ASSERT_EQ(JitFloatFunction::kLanes, 16U);
  for (const std::size_t n : {1U, 3U, 15U, 16U, 17U, 33U, 100U}) {
    std::vector<float> in(inputs * n), out(results * n + 1, 4.0F);
    for (float& x : in) x = number(random);
    in[0] = 1e7F;  // one sample leaves the fast range of sines
    function.batch(in.data(), out.data(), n);
    EXPECT_EQ(out.back(), 4.0F) << "written beyond the end";
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<float> sample(inputs), single(results);
      for (std::size_t i = 0; i < inputs; ++i) sample[i] = in[i * n + k];
      function(sample.data(), single.data());
      for (std::size_t j = 0; j < results; ++j) {
        ASSERT_EQ(std::bit_cast<std::uint32_t>(single[j]),
                  std::bit_cast<std::uint32_t>(out[j * n + k]))
            << "sample " << k << " of " << n << ", result " << j;
      }
    }
  }
}

TEST_P(JitFloat, SinesAreThoseOfTheAngleRoundedOnce) {
  Computation computation;
  computation.inputs = 3;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Ref angle = computation.dag.input(i);
    computation.results.push_back(computation.dag.sin(angle));
    computation.results.push_back(computation.dag.cos(angle));
  }
  // Of an angle that is computed, too.
  computation.results.push_back(computation.dag.sin(
      computation.dag.multiply(computation.dag.input(0), computation.dag.input(1))));
  const JitFloatFunction function = jit_compile_float(computation, {GetParam(), ""});
  std::mt19937 random(3);
  for (int sample = 0; sample < 20000; ++sample) {
    const float range = std::pow(10.0F, std::uniform_real_distribution<float>(-6, 8)(random));
    float in[3], out[7];
    for (float& x : in) x = std::uniform_real_distribution<float>(-range, range)(random);
    function(in, out);
    for (int i = 0; i < 3; ++i) {
      // Half a unit in the last place of a float, and what the double was off.
      const auto expect_rounded = [&](float value, double exact) {
        const auto nearest = static_cast<float>(exact);
        const double unit = std::abs(
            static_cast<double>(std::nextafter(nearest, std::numeric_limits<float>::infinity())) -
            nearest);
        EXPECT_LE(std::abs(value - exact), 0.5000001 * unit) << in[i];
      };
      expect_rounded(out[2 * i], std::sin(static_cast<double>(in[i])));
      expect_rounded(out[2 * i + 1], std::cos(static_cast<double>(in[i])));
    }
    EXPECT_NEAR(out[6], std::sin(static_cast<double>(in[0] * in[1])), 1e-6);
  }
}

TEST_P(JitFloat, RefusesAConstantThatItCannotHold) {
  Computation computation;
  computation.inputs = 1;
  computation.results.push_back(
      computation.dag.multiply(computation.dag.constant(1e200), computation.dag.input(0)));
  try {
    jit_compile_float(computation, {GetParam(), ""});
    FAIL() << "1e200 became a float";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a float cannot hold"), std::string::npos);
  }
}

TEST_P(JitFloat, WithoutABatchFunctionABatchIsMadeOfSingleCalls) {
  const program::ScalarProgram program = program::scalar_program(chain());
  const JitFloatFunction function = jit_compile_float(program, {GetParam(), "", false});
  EXPECT_EQ(function.batch_code_bytes(), 0U);
  const std::size_t inputs = program.computation.inputs,
                    results = program.computation.results.size(), n = 21;
  std::vector<float> in(inputs * n, 0.25F), out(results * n), single(results);
  function.batch(in.data(), out.data(), n);
  function(std::vector<float>(inputs, 0.25F).data(), single.data());
  for (std::size_t j = 0; j < results; ++j) {
    for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(out[j * n + k], single[j]);
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, JitFloat, testing::Values(JitLevel::kFast, JitLevel::kFull),
                         [](const auto& info) {
                           return info.param == JitLevel::kFast ? "fast" : "full";
                         });

}  // namespace
}  // namespace sinew::backend
