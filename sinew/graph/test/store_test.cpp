#include "sinew/graph/store.h"

#include <gtest/gtest.h>

namespace sinew::graph {
namespace {

TEST(Store, AddsAndFindsATriple) {
  Store store;
  Terms& terms = store.terms();
  const Id a = terms.iri("http://x/a"), p = terms.iri("http://x/p"), b = terms.iri("http://x/b");
  EXPECT_TRUE(store.add({a, p, b}));
  EXPECT_FALSE(store.add({a, p, b}));
  EXPECT_TRUE(store.view().contains(a, p, b));
  EXPECT_EQ(store.view().object(a, p), b);
  EXPECT_TRUE(store.remove({a, p, b}));
  EXPECT_FALSE(store.view().contains(a, p, b));
  EXPECT_EQ(store.view().size(), 0u);
}

}  // namespace
}  // namespace sinew::graph
