#include "sinew/program/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sinew/algorithm/operators.h"
#include "sinew/algorithm/quantities.h"
#include "sinew/program/dag/evaluate.h"

namespace sinew::program {
namespace {

TEST(Kernels, EveryOperatorOfTheCatalogueHasOneWithItsPorts) {
  for (const algorithm::Operator& op : algorithm::operators()) {
    if (op.external) continue;  // carried out by the host
    const Kernel* kernel = find_kernel(op.name);
    ASSERT_NE(kernel, nullptr) << op.name;
    const bool many =
        std::any_of(op.ports.begin(), op.ports.end(), [](const auto& port) { return port.many; });
    ASSERT_EQ(kernel->many(), many) << op.name;
    if (many) continue;  // its ports are as many as its closures have
    ASSERT_EQ(kernel->ports.size(), op.ports.size()) << op.name;
    for (std::size_t i = 0; i < op.ports.size(); ++i) {
      const algorithm::Quantity* quantity = algorithm::find_quantity(op.ports[i].quantity);
      ASSERT_NE(quantity, nullptr) << op.name;
      EXPECT_EQ(kernel->ports[i].size, quantity->size) << op.name << ", port " << op.ports[i].name;
      EXPECT_EQ(kernel->ports[i].output, op.ports[i].direction == algorithm::Direction::kOut)
          << op.name << ", port " << op.ports[i].name;
    }
  }
}

TEST(Kernels, ThereIsNoneForAnUnknownOperator) {
  EXPECT_EQ(find_kernel("compose-poses"), nullptr);
  EXPECT_EQ(find_kernel(""), nullptr);
}

TEST(Kernels, AreNamedAfterTheirOperatorInTheSupportLibrary) {
  EXPECT_EQ(support_function("compose-pose"), "sinew_compose_pose");
}

// Recorded and then evaluated, an operator gives what it gives on numbers.
TEST(Kernels, TracedIsTheSameAsNumeric) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  for (const Kernel& kernel : kernels()) {
    if (kernel.many()) continue;  // they compute nothing
    for (int repetition = 0; repetition < 20; ++repetition) {
      Computation c;
      std::vector<double> in;
      std::vector<std::vector<double>> numbers;
      std::vector<std::vector<Traced>> recorded;
      for (const Port& port : kernel.ports) {
        numbers.emplace_back(port.size);
        recorded.emplace_back(port.size);
        if (port.output) continue;
        for (std::uint32_t k = 0; k < port.size; ++k) {
          numbers.back()[k] = uniform(generator);
          recorded.back()[k] = Traced(c.dag, c.dag.input(c.inputs++));
          in.push_back(numbers.back()[k]);
        }
      }
      std::vector<double*> number_arguments;
      std::vector<Traced*> recorded_arguments;
      for (auto& argument : numbers) number_arguments.push_back(argument.data());
      for (auto& argument : recorded) recorded_arguments.push_back(argument.data());
      kernel.evaluate(number_arguments.data());
      kernel.trace(recorded_arguments.data());

      std::vector<double> expected;
      for (std::size_t i = 0; i < kernel.ports.size(); ++i) {
        if (!kernel.ports[i].output) continue;
        expected.insert(expected.end(), numbers[i].begin(), numbers[i].end());
        for (const Traced& value : recorded[i]) c.results.push_back(value.in(c.dag));
      }
      const std::vector<double> out = evaluate(c, in);
      for (std::size_t i = 0; i < out.size(); ++i) {
        EXPECT_NEAR(out[i], expected[i], 1e-13 * (1 + std::abs(expected[i]))) << kernel.operation;
      }
    }
  }
}

}  // namespace
}  // namespace sinew::program
