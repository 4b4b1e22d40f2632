#include "sinew/rdf/isomorphism/isomorphism.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sinew/rdf/isomorphism/refinement.h"

namespace sinew::rdf {
namespace {

using graph::Id;
using graph::Quad;

class Isomorphism : public testing::Test {
 protected:
  graph::Terms terms;
  const Id p = terms.iri("http://x/p");
  const Id q = terms.iri("http://x/q");

  std::vector<Id> fresh(std::size_t count) {
    std::vector<Id> nodes;
    for (std::size_t i = 0; i < count; ++i) nodes.push_back(terms.fresh_blank());
    return nodes;
  }
  Likeness compare(const std::vector<Quad>& left, const std::vector<Quad>& right) {
    return compare_quads(left, right, terms).likeness;
  }
  // A cycle through all the nodes, in this order.
  std::vector<Quad> cycle(const std::vector<Id>& nodes) {
    std::vector<Quad> quads;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      quads.push_back({nodes[i], p, nodes[(i + 1) % nodes.size()]});
    }
    return quads;
  }
};

TEST_F(Isomorphism, ComparesNamedTermsAsTheyAre) {
  const Id a = terms.iri("http://x/a"), b = terms.iri("http://x/b");
  EXPECT_EQ(compare({{a, p, b}, {b, p, a}}, {{b, p, a}, {a, p, b}, {a, p, b}}),
            Likeness::kIsomorphic);
  EXPECT_EQ(compare({{a, p, b}}, {{a, q, b}}), Likeness::kDifferent);
  EXPECT_EQ(compare({{a, p, b}}, {{a, p, b, q}}), Likeness::kDifferent) << "another graph";
}

TEST_F(Isomorphism, SaysWhatDiffers) {
  const Id a = terms.iri("http://x/a"), b = terms.iri("http://x/b");
  const Comparison comparison =
      compare_quads(std::vector<Quad>{{a, p, b}}, std::vector<Quad>{{a, q, b}}, terms);
  EXPECT_EQ(comparison.difference,
            "only on the left:\n  <http://x/a> <http://x/p> <http://x/b> .\n"
            "only on the right:\n  <http://x/a> <http://x/q> <http://x/b> .");
}

TEST_F(Isomorphism, IgnoresTheNamesOfBlankNodes) {
  const std::vector<Id> x = fresh(2), y = fresh(2);
  EXPECT_EQ(compare({{x[0], p, x[1]}, {x[1], q, x[0]}}, {{y[1], p, y[0]}, {y[0], q, y[1]}}),
            Likeness::kIsomorphic);
  EXPECT_EQ(compare({{x[0], p, x[1]}, {x[1], q, x[0]}}, {{y[1], p, y[0]}, {y[1], q, y[0]}}),
            Likeness::kDifferent);
}

TEST_F(Isomorphism, TellsANodeFromTwoThatLookAlike) {
  const std::vector<Id> x = fresh(1), y = fresh(2);
  EXPECT_EQ(compare({{x[0], p, x[0]}}, {{y[0], p, y[1]}}), Likeness::kDifferent);
}

TEST_F(Isomorphism, TakesTheNodesOfBothSidesForDifferentOnesEvenIfTheyAreShared) {
  const std::vector<Id> x = fresh(2);
  EXPECT_EQ(compare({{x[0], p, x[1]}}, {{x[1], p, x[0]}}), Likeness::kIsomorphic);
  EXPECT_EQ(compare({{x[0], p, x[1]}, {x[0], q, x[1]}}, {{x[1], p, x[0]}, {x[0], q, x[1]}}),
            Likeness::kDifferent);
}

TEST_F(Isomorphism, LooksAtBlankNodesInEveryField) {
  const Id a = terms.iri("http://x/a");
  const std::vector<Id> x = fresh(3), y = fresh(3);
  EXPECT_EQ(compare({{a, x[0], a, x[1]}, {x[1], p, x[0]}}, {{a, y[2], a, y[0]}, {y[0], p, y[2]}}),
            Likeness::kIsomorphic);
  EXPECT_EQ(compare({{a, x[0], a, x[1]}, {x[1], p, x[0]}}, {{a, y[2], a, y[0]}, {y[2], p, y[0]}}),
            Likeness::kDifferent);
}

TEST_F(Isomorphism, TellsOneCycleFromTwoThoughEveryNodeSeesTheSame) {
  std::vector<Id> x = fresh(6), y = fresh(6);
  std::vector<Quad> two = cycle({y[0], y[1], y[2]});
  for (const Quad& quad : cycle({y[3], y[4], y[5]})) two.push_back(quad);
  EXPECT_EQ(compare(cycle(x), two), Likeness::kDifferent);
  std::ranges::reverse(y);
  EXPECT_EQ(compare(cycle(x), cycle(y)), Likeness::kIsomorphic);
}

TEST_F(Isomorphism, PairsManyNodesThatAreAllAlike) {
  const std::vector<Id> x = fresh(500), y = fresh(500);
  std::vector<Quad> left, right;
  for (std::size_t i = 0; i < x.size(); ++i) {
    left.push_back({x[i], p, q});
    right.push_back({y[i], p, q});
  }
  EXPECT_EQ(compare(left, right), Likeness::kIsomorphic);
}

TEST_F(Isomorphism, IsQuickForALongListOfEqualNumbers) {
  const Id zero = terms.integer(0), nil = terms.iri("http://x/nil");
  const auto list_of = [&](std::size_t length) {
    const std::vector<Id> cells = fresh(length);
    std::vector<Quad> quads;
    for (std::size_t i = 0; i < length; ++i) {
      quads.push_back({cells[i], p, zero});
      quads.push_back({cells[i], q, i + 1 < length ? cells[i + 1] : nil});
    }
    std::shuffle(quads.begin(), quads.end(), std::mt19937(1));
    return quads;
  };
  EXPECT_EQ(compare(list_of(20000), list_of(20000)), Likeness::kIsomorphic);
}

TEST_F(Isomorphism, GivesUpInsteadOfRunningForever) {
  const std::vector<Id> x = fresh(200), y = fresh(200);
  const Comparison comparison = compare_quads(cycle(x), cycle(y), terms, 100);
  EXPECT_EQ(comparison.likeness, Likeness::kUndecided);
  EXPECT_FALSE(comparison.difference.empty());
}

TEST_F(Isomorphism, OrdersBlankNodesByWhatTheyAreAndNotByTheirIds) {
  const Id one = terms.integer(1), two = terms.integer(2), three = terms.integer(3);
  const std::vector<Id> x = fresh(3), y = fresh(3);
  const std::vector<Quad> left = {{x[0], p, one}, {x[1], p, two}, {x[2], p, three}};
  const std::vector<Quad> right = {{y[0], p, three}, {y[1], p, one}, {y[2], p, two}};
  const std::vector<Id> l = ordered_blanks(left, terms), r = ordered_blanks(right, terms);
  const auto value = [](const std::vector<Quad>& quads, Id node) {
    return std::ranges::find(quads, node, &Quad::subject)->object;
  };
  ASSERT_EQ(l.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(value(left, l[i]), value(right, r[i]));
}

TEST_F(Isomorphism, OrdersEvenNodesThatAreAllAlikeInLittleTime) {
  std::vector<Quad> quads;
  for (int i = 0; i < 20000; ++i) {
    const std::vector<Id> x = fresh(2);
    quads.push_back({x[0], p, x[1]});
    quads.push_back({x[1], p, x[0]});
  }
  const std::vector<Id> order = ordered_blanks(quads, terms);
  EXPECT_EQ(order.size(), 40000u);
}

// Random graphs with few predicates, renamed and shuffled; and the same with one arc moved.
TEST_F(Isomorphism, AgreesWithHowTheGraphsWereMade) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    const std::size_t size = 2 + random() % 12;
    const std::vector<Id> x = fresh(size);
    std::vector<Id> y = fresh(size);
    std::ranges::shuffle(y, random);
    std::vector<std::array<std::size_t, 3>> arcs;
    for (std::size_t i = 0; i < size * 2; ++i) {
      arcs.push_back({random() % size, random() % 2, random() % size});
    }
    std::ranges::sort(arcs);
    arcs.erase(std::ranges::unique(arcs).begin(), arcs.end());
    const auto quads_over = [&](const std::vector<Id>& nodes) {
      std::vector<Quad> quads;
      for (const auto& [from, label, to] : arcs) {
        quads.push_back({nodes[from], label == 0 ? p : q, nodes[to]});
      }
      return quads;
    };
    const std::vector<Quad> left = quads_over(x);
    std::vector<Quad> right = quads_over(y);
    std::ranges::shuffle(right, random);
    EXPECT_EQ(compare(left, right), Likeness::kIsomorphic);
    right.back().predicate = right.back().predicate == p ? q : p;
    const auto with_p = [&](const std::vector<Quad>& quads) {
      return std::ranges::count(quads, p, &Quad::predicate);
    };
    if (with_p(left) != with_p(right)) {
      EXPECT_EQ(compare(left, right), Likeness::kDifferent);
    }
  }
}

}  // namespace
}  // namespace sinew::rdf
