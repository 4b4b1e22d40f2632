// Terms with many triples: what is between two of them is found by hash, from the moment on when
// both have many; and adding many triples at once.
#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/store.h"

namespace sinew::graph {
namespace {

constexpr int kMany = 60;  // more than kUncrowded

struct Crowded : ::testing::Test {
  Crowded() {
    for (int i = 0; i < 4 * kMany; ++i) node.push_back(store.terms().integer(i));
  }
  static std::vector<Id> between(const View& view, Id subject, Id object) {
    std::vector<Id> predicates;
    view.match(subject, {}, object, Dataset::kUnion,
               [&](const Quad& quad) { return predicates.push_back(quad.predicate), true; });
    return predicates;
  }
  // Gives a subject many objects, or an object many subjects.
  void crowd_subject(Transaction& to, Id subject) {
    for (int i = 0; i < kMany; ++i) to.add({subject, node[0], node[kMany + i]});
  }
  void crowd_object(Transaction& to, Id object) {
    for (int i = 0; i < kMany; ++i) to.add({node[2 * kMany + i], node[0], object});
  }
  Store store;
  std::vector<Id> node;
};

TEST_F(Crowded, WhatIsBetweenTwoIsFoundInOrderWhicheverBecomesCrowdedFirst) {
  const Id a = node[1], b = node[2];
  for (const bool subject_first : {true, false}) {
    store = Store();
    Transaction transaction = store.begin();
    for (int i = 0; i < 4 * kMany; ++i) store.terms().integer(i);
    transaction.add({a, node[5], b});
    transaction.add({a, node[3], b});
    if (subject_first) crowd_subject(transaction, a);
    transaction.add({a, node[4], b});
    crowd_object(transaction, b);
    transaction.add({a, node[9], b});
    if (!subject_first) crowd_subject(transaction, a);
    transaction.add({a, node[7], b});
    transaction.commit();
    EXPECT_EQ(between(store.view(), a, b),
              (std::vector<Id>{node[5], node[3], node[4], node[9], node[7]}));
    EXPECT_TRUE(between(store.view(), b, a).empty());
    EXPECT_EQ(between(store.view(), a, node[kMany + 3]), std::vector<Id>{node[0]});
    EXPECT_GE(store.view().estimate(a, {}, b), 5u);
    EXPECT_LE(store.view().estimate(a, {}, b), kMany);
  }
}

TEST_F(Crowded, TakingBackWhatMadeThemCrowdedLosesNothing) {
  const Id a = node[1], b = node[2];
  store.add({a, node[3], b});
  const Snapshot before = store.snapshot();
  Transaction transaction = store.begin();
  transaction.add({a, node[4], b});
  for (int round = 0; round < 3; ++round) {
    const auto mark = transaction.mark();
    crowd_subject(transaction, a);
    crowd_object(transaction, b);
    transaction.add({a, node[6 + round], b});
    EXPECT_EQ(between(transaction.view(), a, b),
              (std::vector<Id>{node[3], node[4], node[6 + round]}));
    EXPECT_EQ(between(before, a, b), std::vector<Id>{node[3]});
    transaction.undo_to(mark);
    EXPECT_EQ(between(transaction.view(), a, b), (std::vector<Id>{node[3], node[4]}));
  }
  transaction.undo_to(0);
  EXPECT_EQ(between(transaction.view(), a, b), std::vector<Id>{node[3]});
  transaction.add({a, node[5], b});
  crowd_subject(transaction, a);
  transaction.commit();
  EXPECT_EQ(between(store.view(), a, b), (std::vector<Id>{node[3], node[5]}));
  EXPECT_EQ(between(before, a, b), std::vector<Id>{node[3]});
}

TEST_F(Crowded, RemovedTriplesLeaveAndOldSnapshotsKeepThem) {
  const Id a = node[1], b = node[2];
  Transaction filling = store.begin();
  crowd_subject(filling, a);
  crowd_object(filling, b);
  for (int i = 10; i < 30; ++i) filling.add({a, node[i], b});
  filling.commit();
  const Snapshot full = store.snapshot();
  for (int round = 0; round < 5; ++round) {
    for (int i = 10; i < 30; ++i) EXPECT_TRUE(store.remove({a, node[i], b}));
    EXPECT_TRUE(between(store.view(), a, b).empty());
    for (int i = 10; i < 30; ++i) EXPECT_TRUE(store.add({a, node[i], b}));
    EXPECT_EQ(between(store.view(), a, b).size(), 20u);
  }
  EXPECT_EQ(between(full, a, b).size(), 20u);
}

// So many that the way for stores beyond the caches is taken; with quads that come twice.
TEST(AddAtOnce, DoesTheSameAsOneAfterTheOther) {
  std::mt19937 random(3);
  Store one, many;
  std::vector<Id> terms;
  for (int i = 0; i < 3000; ++i) {
    terms.push_back(one.terms().integer(i));
    many.terms().integer(i);
  }
  std::vector<Quad> quads;
  std::set<Quad> model;
  for (int i = 0; i < 60'000; ++i) {
    const auto any = [&](unsigned among) { return terms[random() % among]; };
    quads.push_back({any(3000), any(5), any(3000), random() % 4 == 0 ? any(3) : Id{}});
    model.insert(quads.back());
  }
  quads.insert(quads.end(), quads.begin(), quads.begin() + 5000);
  Transaction each = one.begin(), at_once = many.begin();
  std::size_t count = 0;
  for (const Quad& quad : quads) count += each.add(quad);
  EXPECT_EQ(at_once.add(quads), count);
  EXPECT_EQ(count, model.size());
  const auto all = [](const View& view) {
    std::vector<Quad> found;
    view.match({}, {}, {}, Dataset::kUnion,
               [&](const Quad& quad) { return found.push_back(quad), true; });
    return found;
  };
  EXPECT_EQ(all(each.view()), all(at_once.view()));
  EXPECT_EQ(each.view().size(), at_once.view().size());
  for (int i = 0; i < 2000; ++i) {
    const Quad& quad = quads[random() % quads.size()];
    EXPECT_TRUE(at_once.view().contains_in(quad));
  }
  at_once.undo_to(0);
  EXPECT_EQ(at_once.view().size(), 0u);
  EXPECT_TRUE(all(at_once.view()).empty());
  EXPECT_EQ(at_once.add(quads), model.size());
}

TEST(AddAtOnce, AddsWhatComesBeforeAQuadThatIsRefused) {
  Store store;
  const Id a = store.terms().iri("http://x/a"), b = store.terms().iri("http://x/b");
  const std::vector<Quad> quads = {{a, a, a}, {a, a, b}, {a, a, Id{1u << 30}}, {b, b, b}};
  Transaction transaction = store.begin();
  EXPECT_THROW(transaction.add(quads), Error);
  EXPECT_EQ(transaction.view().size(), 2u);
  EXPECT_FALSE(transaction.view().contains(b, b, b));
}

}  // namespace
}  // namespace sinew::graph
