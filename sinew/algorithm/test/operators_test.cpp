#include "sinew/algorithm/operators.h"

#include <gtest/gtest.h>

namespace sinew::algorithm {
namespace {

TEST(Operators, EachIsFoundByItsNameAndByItsIri) {
  ASSERT_FALSE(operators().empty());
  for (const Operator& op : operators()) {
    EXPECT_EQ(find_operator(op.name), &op);
    EXPECT_EQ(find_operator_by_iri(op.iri), &op);
  }
  EXPECT_EQ(find_operator("no-such-operator"), nullptr);
}

TEST(Operators, HaveTheirInputsFirstAndExactlyOneOutputLast) {
  for (const Operator& op : operators()) {
    if (op.external) continue;
    ASSERT_FALSE(op.ports.empty()) << op.name;
    for (std::size_t i = 0; i < op.ports.size(); ++i)
      EXPECT_EQ(op.ports[i].direction == Direction::kOut, i + 1 == op.ports.size()) << op.name;
  }
}

TEST(Operators, UseThePublishedIrisWhereThereAreSome) {
  const Operator* compose = find_operator("compose-pose");
  ASSERT_NE(compose, nullptr);
  EXPECT_EQ(compose->iri,
            "https://comp-rob2b.github.io/metamodels/geometry/spatial-operators#ComposePose");
  EXPECT_EQ(compose->ports[2].iri,
            "https://comp-rob2b.github.io/metamodels/geometry/spatial-operators#composite");
}

TEST(Operators, StateTheirFrameRulesAsText) {
  const Operator* compose = find_operator("compose-pose");
  ASSERT_EQ(compose->rules.size(), 3u);
  EXPECT_EQ(to_string(compose->rules[0], *compose), "in1.of = in2.with-respect-to");
}

// Every symbol that an output's quantity needs is tied to an input by some rule: nothing comes out
// of an operator whose meaning could be chosen at will.
TEST(Operators, TieEverySymbolOfTheirOutputToAnInput) {
  for (const Operator& op : operators()) {
    if (op.external) continue;
    const auto out = static_cast<std::uint8_t>(op.ports.size() - 1);
    const Quantity& quantity = *find_quantity(op.ports[out].quantity);
    for (const Attribute attribute :
         {Attribute::kOf, Attribute::kWrt, Attribute::kReference, Attribute::kSeenBy}) {
      if (!needs(quantity, attribute)) continue;
      bool tied = quantity.name.ends_with("-force") ||
                  op.name == "joint-acceleration-of-signal";  // of a joint that the builder names
      for (const FrameRule& rule : op.rules)
        tied |= ((rule.left.port == out && rule.left.attribute == attribute) ||
                 (rule.right.port == out && rule.right.attribute == attribute));
      EXPECT_TRUE(tied) << op.name << ": " << to_string(attribute) << " of its output";
    }
  }
}

// A port of open unit is in a rule that ties it to another, or to a unit: no number's unit can be
// chosen at will.
TEST(Operators, TieEveryOpenUnitByARule) {
  for (const Operator& op : operators())
    for (std::uint8_t port = 0; port < op.ports.size(); ++port) {
      const Quantity* quantity = find_quantity(op.ports[port].quantity);
      if (quantity == nullptr || !quantity->unit.empty()) continue;
      bool tied = false;
      for (const UnitRule& rule : op.unit_rules)
        for (const UnitRule::Factor& factor : rule.factors) tied |= factor.port == port;
      EXPECT_TRUE(tied) << op.name << ": " << op.ports[port].name;
    }
}

}  // namespace
}  // namespace sinew::algorithm
