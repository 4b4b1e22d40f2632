// Costs of single operators, beside textbook formulas; chains of small programs.
#include "sinew/program/facts.h"

#include <gtest/gtest.h>

#include <array>

namespace sinew::program {
namespace {

OperationCount cost(const char* operation, std::vector<std::uint32_t> sizes) {
  return cost_of(*find_kernel(operation), sizes);
}

TEST(CostOf, TwoPosesIsThatOfAMatrixProductAndARotatedVector) {
  // R1 R2: 27 multiplications, 18 additions; R1 p2 + p1: 9 and 9.
  const OperationCount count = cost("compose-pose", {12, 12, 12});
  EXPECT_EQ(count.multiply, 36u);
  EXPECT_EQ(count.add, 27u);
  EXPECT_EQ(count.divide + count.sqrt + count.sincos, 0u);
}

TEST(CostOf, ARevoluteJointHasOneSineWithItsCosine) {
  EXPECT_EQ(cost("position-to-pose-revolute", {1, 12}).sincos, 1u);
}

TEST(CostOf, ADampingControllerDividesOnce) {
  // f = f_max - f_max / v_max v
  const OperationCount count = cost("damping", {1, 1, 1, 1});
  EXPECT_EQ(count.divide, 1u);
  EXPECT_EQ(count.multiply, 1u);
  EXPECT_EQ(count.add, 1u);
}

TEST(CostOf, EveryOperatorIsCounted) {
  for (const Kernel& kernel : kernels()) {
    if (kernel.many()) continue;  // their sizes are the closure's
    std::vector<std::uint32_t> sizes;
    for (const Port& port : kernel.ports) sizes.push_back(port.size);
    EXPECT_NO_THROW(cost_of(kernel, sizes)) << kernel.operation;
  }
}

// a -> b -> c, and a -> d: what reads the same number does not wait for each other.
TEST(LongestChain, DoesNotCountThoseWhoOnlyReadTheSame) {
  Program program;
  for (const char* name : {"a", "b", "c", "d"})
    program.variables.push_back(
        {name, name, "", "joint-force", "N-M", "", Role::kInternal, false, 1, {}});
  program.variables[0].role = Role::kInput;
  const auto add = [&](std::uint32_t from, std::uint32_t to) {
    program.schedule.push_back(static_cast<std::uint32_t>(program.closures.size()));
    program.closures.push_back({"add-joint-force", "", "", "", {from, from, to}});
  };
  add(0, 1);
  add(0, 3);
  add(1, 2);
  EXPECT_EQ(longest_chain(program), 2u);
  add(1, 3);
  EXPECT_EQ(longest_chain(program), 2u);
}

TEST(LongestChain, AStateMakesNobodyWait) {
  Program program;
  program.variables = {{"in", "", "", "joint-force", "N-M", "", Role::kInput, false, 1, {}},
                       {"kept", "", "", "joint-force", "N-M", "", Role::kState, false, 1, {0}},
                       {"out", "", "", "joint-force", "N-M", "", Role::kInternal, true, 1, {}}};
  program.closures = {{"add-joint-force", "", "", "", {0, 1, 2}},
                      {"add-joint-force", "", "", "", {2, 0, 1}}};
  program.schedule = {0, 1};
  EXPECT_EQ(longest_chain(program), 2u);
}

}  // namespace
}  // namespace sinew::program
