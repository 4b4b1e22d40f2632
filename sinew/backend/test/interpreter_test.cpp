#include "sinew/backend/interpreter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "allocations.h"
#include "serial_chain.h"
#include "sinew/base/error.h"
#include "sinew/program/derivatives.h"

namespace sinew {
namespace {

std::vector<double> random_inputs(std::size_t n, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  std::vector<double> values(n);
  for (double& value : values) value = uniform(generator);
  return values;
}

TEST(Interpreter, AgreesWithDenseTextbookInverseDynamics) {
  const auto joints = test::mixed_chain();
  backend::Interpreter interpreter(test::inverse_dynamics(joints));
  ASSERT_EQ(interpreter.in_size(), 21U);
  ASSERT_EQ(interpreter.out_size(), 7U);
  for (unsigned seed = 0; seed < 100; ++seed) {
    const std::vector<double> in = random_inputs(21, seed);
    std::vector<double> out(7);
    interpreter.evaluate(in.data(), out.data());
    const std::vector<double> expected = test::dense_inverse_dynamics(
        joints, {in.begin(), in.begin() + 7}, {in.begin() + 7, in.begin() + 14},
        {in.begin() + 14, in.end()});
    // Outputs are in the order of the program's variables: the last joint's force was made first.
    for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(out[6 - k], expected[k], 1e-11) << k;
  }
}

TEST(Interpreter, TakesNoMemoryWhileItEvaluates) {
  backend::Interpreter interpreter(test::inverse_dynamics(test::mixed_chain()));
  const std::vector<double> in = random_inputs(21, 1);
  std::vector<double> out(7);
  const std::size_t before = allocations();
  for (int k = 0; k < 100; ++k) interpreter.evaluate(in.data(), out.data());
  interpreter.reset();
  EXPECT_EQ(allocations(), before);
}

TEST(Interpreter, EvaluatesDerivativesWithoutAllocating) {
  program::Program program = test::inverse_dynamics(test::mixed_chain());
  const std::string some_input =
      program.variables[program::interface_of(program).inputs[0].variable].name;
  const std::string some_output =
      program.variables[program::interface_of(program).outputs[0].variable].name;
  program::add_derivatives(program, std::vector<std::string>{some_output + "/" + some_input});
  backend::Interpreter interpreter(program);
  const std::vector<double> in = random_inputs(interpreter.in_size(), 1);
  std::vector<double> out(interpreter.out_size());
  const std::size_t before = allocations();
  for (int k = 0; k < 100; ++k) interpreter.evaluate(in.data(), out.data());
  interpreter.reset();
  EXPECT_EQ(allocations(), before);
}

TEST(Interpreter, RefusesAProgramThatIsNotValid) {
  program::Program program = test::inverse_dynamics(test::mixed_chain());
  std::swap(program.schedule.front(), program.schedule.back());
  EXPECT_THROW(backend::Interpreter{program}, Error);
}

TEST(Interpreter, CarriesStatesFromOneEvaluationToTheNext) {
  backend::Interpreter interpreter(test::running_sum());
  const std::vector<double> in(6, 10.0);
  std::vector<double> out(6);
  interpreter.evaluate(in.data(), out.data());
  EXPECT_EQ(out, (std::vector<double>{11, 12, 13, 14, 15, 16}));
  interpreter.evaluate(in.data(), out.data());
  EXPECT_EQ(out, (std::vector<double>{21, 22, 23, 24, 25, 26}));
  interpreter.reset();
  interpreter.evaluate(in.data(), out.data());
  EXPECT_EQ(out, (std::vector<double>{11, 12, 13, 14, 15, 16}));
}

}  // namespace
}  // namespace sinew
