#include "sinew/backend/interpreter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "allocations.h"
#include "refusal.h"
#include "serial_chain.h"
#include "sinew/base/error.h"
#include "sinew/program/derivatives.h"
#include "sinew/program/scalar_program.h"

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

// The acceleration of a joint whose unit force is constant: what it weighs about its axis.
program::Program joint_of(double unit_force) {
  using program::Role;
  using program::Variable;
  const auto variable = [](const std::string& name, Role role, std::uint32_t size) {
    Variable v;
    v.name = name;
    v.represents = "https://example.org/joint";
    v.role = role;
    v.size = size;
    return v;
  };
  program::Program program;
  program.iri = "https://example.org/program";
  program.variables = {variable("force", Role::kInput, 1), variable("wrench", Role::kInput, 6),
                       variable("unit", Role::kConstant, 1), variable("twist", Role::kInput, 6),
                       variable("acceleration", Role::kInternal, 1)};
  program.variables[2].value = {unit_force};
  program.variables[4].output = true;
  program.closures = {{"joint-acceleration-from-force",
                       "https://example.org/closure",
                       "https://example.org/step",
                       "https://example.org/joint",
                       {0, 1, 2, 3, 4}}};
  program.schedule = {0};
  return program;
}

TEST(Interpreter, RefusesADivisionByAConstantZeroLikeGeneratedCode) {
  EXPECT_EQ(refusal([] { backend::Interpreter{joint_of(0.5)}; }), "none");
  const std::string text = refusal([] { backend::Interpreter{joint_of(0)}; });
  EXPECT_NE(text.find("https://example.org/joint: its 'joint-acceleration-from-force' divides "
                      "by zero"),
            std::string::npos)
      << text;
  EXPECT_EQ(text, refusal([] { program::scalar_program(joint_of(0)); }));
}

TEST(Interpreter, MindsNoDivisionByZeroThatNothingUses) {
  program::Program program = joint_of(0);
  program.variables[4].output = false;
  EXPECT_EQ(refusal([&] { backend::Interpreter{program}; }), "none");
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
