#include "sinew/backend/jit/block_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "sinew/program/dag/evaluate.h"

namespace {

using sinew::backend::depth_first_order;
using sinew::backend::frugal_order;
using sinew::program::arity;
using sinew::program::Computation;
using sinew::program::Node;
using sinew::program::Op;
using sinew::program::Ref;

using Order = std::vector<std::uint32_t>;

std::vector<std::uint32_t> operands_of(const Node& node) {
  const Ref operands[] = {node.a, node.b, node.c};
  std::vector<std::uint32_t> result;
  for (int k = 0; k < arity(node.op); ++k) result.push_back(operands[k].node());
  return result;
}

// The most values of operations that are alive at once.
std::size_t most_alive(const Computation& computation, const Order& order) {
  std::vector<std::size_t> unread(computation.dag.size(), 0);
  for (const std::uint32_t node : order) {
    for (const std::uint32_t operand : operands_of(computation.dag.node(node))) ++unread[operand];
  }
  std::size_t alive = 0, most = 0;
  for (const std::uint32_t node : order) {
    for (const std::uint32_t operand : operands_of(computation.dag.node(node))) {
      if (--unread[operand] == 0 && arity(computation.dag.node(operand).op) > 0) --alive;
    }
    if (arity(computation.dag.node(node).op) > 0 && unread[node] > 0) ++alive;
    most = std::max(most, alive);
  }
  return most;
}

// What is wrong with an order; empty if nothing is.
std::string fault_of(const Computation& computation, const Order& order) {
  const std::vector<std::uint8_t> live = sinew::program::live_nodes(computation);
  std::vector<bool> done(computation.dag.size(), false);
  for (const std::uint32_t node : order) {
    if (!live[node]) return "a node that nothing depends on";
    if (done[node]) return "a node twice";
    for (const std::uint32_t operand : operands_of(computation.dag.node(node))) {
      if (!done[operand]) return "a node before its operand";
    }
    done[node] = true;
  }
  const auto wanted = static_cast<std::size_t>(std::count(live.begin(), live.end(), 1));
  return order.size() == wanted ? "" : "a node is missing";
}

Computation random_computation(unsigned seed) {
  std::mt19937 random(seed);
  Computation c;
  c.inputs = 5;
  std::vector<Ref> values;
  for (std::uint32_t i = 0; i < c.inputs; ++i) values.push_back(c.dag.input(i));
  values.push_back(c.dag.sin(values[0]));
  values.push_back(c.dag.constant(0.5));
  const auto any = [&] { return values[random() % values.size()]; };
  for (int k = 0; k < 60; ++k) {
    const Ref a = any(), b = any();
    values.push_back(random() % 2 == 0 ? c.dag.add(a, b) : c.dag.fma(a, b, any()));
  }
  for (int k = 0; k < 6; ++k) c.results.push_back(any());
  return c;
}

TEST(BlockOrder, HasEachNodeThatIsNeededOnceAfterItsOperands) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Computation computation = random_computation(seed);
    EXPECT_EQ(fault_of(computation, frugal_order(computation)), "") << seed;
    EXPECT_EQ(fault_of(computation, depth_first_order(computation)), "") << seed;
  }
}

// Products first and their sum behind them, as a graph may have them.
Computation sum_of_products(std::uint32_t n) {
  Computation c;
  c.inputs = 2 * n;
  std::vector<Ref> products;
  for (std::uint32_t i = 0; i < n; ++i) {
    products.push_back(c.dag.multiply(c.dag.input(2 * i), c.dag.input(2 * i + 1)));
  }
  Ref sum = products[0];
  for (std::uint32_t i = 1; i < n; ++i) sum = c.dag.add(sum, products[i]);
  c.results.push_back(sum);
  return c;
}

TEST(BlockOrder, KeepsFewValuesAlive) {
  const Computation computation = sum_of_products(20);
  Order as_it_is(computation.dag.size());
  for (std::uint32_t i = 0; i < as_it_is.size(); ++i) as_it_is[i] = i;
  EXPECT_EQ(most_alive(computation, as_it_is), 20u);
  EXPECT_EQ(most_alive(computation, frugal_order(computation)), 2u);
  EXPECT_EQ(most_alive(computation, depth_first_order(computation)), 2u);
}

TEST(BlockOrder, GoesDepthFirstWhereMostRegistersAreNeeded) {
  // A product, and a sum of products, which needs two registers: it comes first, or three would be
  // alive.
  Computation c;
  c.inputs = 6;
  const auto product = [&](std::uint32_t i) {
    return c.dag.multiply(c.dag.input(i), c.dag.input(i + 1));
  };
  const Ref one = product(0);
  const Ref two = c.dag.add(product(2), product(4));
  c.results.push_back(c.dag.add(one, two));
  EXPECT_EQ(most_alive(c, depth_first_order(c)), 2u);
}

}  // namespace
