// The index of boxes against looking at every box, while boxes come, move and go.
#include "sinew/world/space_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace sinew::world {
namespace {

bool meet(const Bounds3& a, const Bounds3& b) {
  return a.minimum.x <= b.maximum.x && a.maximum.x >= b.minimum.x && a.minimum.y <= b.maximum.y &&
         a.maximum.y >= b.minimum.y && a.minimum.z <= b.maximum.z && a.maximum.z >= b.minimum.z;
}

class Boxes {
 public:
  explicit Boxes(unsigned seed) : random_(seed) {}

  Bounds3 anywhere(double hall, double largest) {
    std::uniform_real_distribution<double> at(-hall, hall), size(0, largest);
    const Vector3 from = {at(random_), at(random_), at(random_)};
    return {from, from + Vector3{size(random_), size(random_), size(random_)}};
  }
  void set(Index number, const Bounds3& box) {
    all_[number] = box;
    index.set(number, box);
  }
  void remove(Index number) {
    all_.erase(number);
    index.remove(number);
  }
  // The index misses none that meets the region, has none twice, and none that a float's rounding
  // does not explain.
  void check(const Bounds3& region, std::size_t* hits) const {
    std::vector<Index> found;
    index.search(region, found);
    std::sort(found.begin(), found.end());
    ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    const Vector3 rounding = {1e-4, 1e-4, 1e-4};
    const Bounds3 wide = {region.minimum - rounding, region.maximum + rounding};
    for (const auto& [number, box] : all_) {
      const bool is_found = std::binary_search(found.begin(), found.end(), number);
      if (meet(box, region)) {
        ASSERT_TRUE(is_found) << number;
        ++*hits;
      }
      if (is_found) {
        ASSERT_TRUE(meet(box, wide)) << number;
      }
    }
    for (const Index number : found) ASSERT_TRUE(all_.contains(number)) << number;
    ASSERT_EQ(index.size(), all_.size());
  }
  Index some() {
    auto at = all_.begin();
    std::advance(at, static_cast<long>(random_() % all_.size()));
    return at->first;
  }
  std::mt19937_64& random() { return random_; }
  std::size_t size() const { return all_.size(); }

  SpaceIndex index;

 private:
  std::mt19937_64 random_;
  std::map<Index, Bounds3> all_;
};

TEST(SpaceIndex, AnswersAsLookingAtEveryBoxDoes) {
  std::size_t hits = 0;
  for (const unsigned seed : {1u, 2u, 3u}) {
    Boxes boxes(seed);
    Index next = 0;
    for (int round = 0; round < 60; ++round) {
      // More and more, then fewer; the small and the huge together.
      for (int i = 0; i < (round < 40 ? 30 : 5); ++i) {
        boxes.set(next++, boxes.anywhere(100, i % 10 == 0 ? 150 : 3));
      }
      for (int i = 0; i < 20; ++i) {
        const Index number = boxes.some();
        boxes.set(number, boxes.anywhere(100, 3));
      }
      for (int i = 0; i < (round < 40 ? 5 : 40) && boxes.size() > 1; ++i) {
        boxes.remove(boxes.some());
      }
      if (round % 2) boxes.index.settle();
      for (int i = 0; i < 5; ++i) boxes.check(boxes.anywhere(100, i * 60), &hits);
    }
  }
  EXPECT_GT(hits, 5'000u);
}

TEST(SpaceIndex, HoldsNothingAtFirstAndAfterAllHasGone) {
  Boxes boxes(4);
  std::size_t hits = 0;
  boxes.check(boxes.anywhere(10, 100), &hits);
  boxes.index.settle();
  boxes.check(boxes.anywhere(10, 100), &hits);
  for (Index i = 0; i < 1000; ++i) boxes.set(i, boxes.anywhere(10, 1));
  boxes.index.settle();
  for (Index i = 0; i < 1000; ++i) boxes.remove(i);
  boxes.index.remove(5);  // not there any more
  boxes.check({{-100, -100, -100}, {100, 100, 100}}, &hits);
  boxes.index.settle();
  boxes.check({{-100, -100, -100}, {100, 100, 100}}, &hits);
  EXPECT_EQ(hits, 0u);
}

// Boxes that share a place are no cells of a space-filling curve apart.
TEST(SpaceIndex, FindsAllThatAreInOnePlace) {
  Boxes boxes(5);
  for (Index i = 0; i < 500; ++i) boxes.set(i, {{1, 2, 3}, {1, 2, 3}});
  boxes.index.settle();
  std::size_t hits = 0;
  boxes.check({{1, 2, 3}, {1, 2, 3}}, &hits);
  EXPECT_EQ(hits, 500u);
  boxes.check({{1.1, 2, 3}, {2, 3, 4}}, &hits);
  EXPECT_EQ(hits, 500u);
}

// Floats have 24 bits: far from the origin they are rounded outwards, and nothing is missed.
TEST(SpaceIndex, MissesNothingFarFromTheOrigin) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> offset(0, 10);
  const auto near = [&](double size) {
    const Vector3 from = {1e7 + offset(random), -1e7 + offset(random), 1e7 + offset(random)};
    return Bounds3{from, from + Vector3{size, size, size}};
  };
  SpaceIndex index;
  std::vector<Bounds3> all;
  for (Index i = 0; i < 300; ++i) {
    all.push_back(near(0.01));
    index.set(i, all.back());
  }
  index.settle();
  std::size_t hits = 0;
  for (int k = 0; k < 50; ++k) {
    const Bounds3 region = near(2);
    std::vector<Index> found;
    index.search(region, found);
    for (Index i = 0; i < 300; ++i) {
      if (!meet(all[i], region)) continue;
      EXPECT_NE(std::find(found.begin(), found.end(), i), found.end());
      ++hits;
    }
  }
  EXPECT_GT(hits, 50u);
}

}  // namespace
}  // namespace sinew::world
